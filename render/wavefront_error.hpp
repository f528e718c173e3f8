// How far a frame's wavefronts are from the double-precision tracer's for the same directions and distances.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "render/renderer.hpp"

namespace render {

// D, of the pixels that have a wavefront in both; 99 of 100 differ by no more.
struct WavefrontError {
  double power_p99 = 0.0, astigmatism_p99 = 0.0;
};

// One view's pixels, traced once through the lens in double precision; what a frame met there is taken from it.
class WavefrontReference {
 public:
  // Not all pixels where there are more than `most`: those of an even grid.
  WavefrontReference(const lenses::LensModel& lenses, const ViewSetup& view, int width, int height,
                     std::size_t most = 40000);

  // Appends to both lists, a value a pixel (D). The planes have the size given above; pixels without a wavefront on
  // either side have none.
  void append_differences(const WavefrontPlanes& planes, std::vector<double>& power,
                          std::vector<double>& astigmatism) const;

 private:
  struct Point {
    std::size_t pixel;
    bool through_lens;
    lenses::f64::RayTransfer transfer;
  };
  std::vector<Point> points_;
};

// Nothing where there is nothing to compare.
[[nodiscard]] std::optional<WavefrontError> wavefront_error(std::vector<double> power, std::vector<double> astigmatism);

}  // namespace render
