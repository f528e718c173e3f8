#include "lenses/pupil.hpp"

#include <cmath>

namespace lenses {

double pupil_diameter_in_light(double luminance, double area_deg2, bool both_eyes, double age) {
  constexpr double kReferenceAge = 28.58;
  const double flux = luminance * area_deg2 * (both_eyes ? 1.0 : 0.1);
  const double w = std::pow(flux / 846.0, 0.41);
  const double young = 7.75 - 5.75 * w / (w + 2.0);
  return 1e-3 * (young + (age - kReferenceAge) * (0.02132 - 0.009562 * young));
}

}  // namespace lenses
