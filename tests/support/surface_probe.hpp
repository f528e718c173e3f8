// Heights and curvatures of a surface as the reference engine sees them, and of any function by differences.
#pragma once

#include <functional>

#include "lenses/lens_model.hpp"

namespace support {

class SurfaceProbe {
 public:
  explicit SurfaceProbe(const lenses::Surface& surface) {
    lenses::Lens lens;
    lens.diameter = 0.2;
    lens.front = surface;
    lenses::append_lens(model_, &lens, lenses::Side::right, 0.003);
  }
  [[nodiscard]] lenses::f64::SurfacePoint at(double x, double y) const {
    return lenses::f64::surface_point(lenses::f64::Table{model_.table}, model_.lens[0].front, {x, y});
  }

 private:
  lenses::LensModel model_;
};

// Second derivatives xx, xy, yy of a smooth function by fourth-order differences.
inline glm::dvec3 hessian_of(const std::function<double(double, double)>& f, double x, double y, double step = 2e-4) {
  const auto along = [&](double dx, double dy) {
    return (-f(x + 2 * dx, y + 2 * dy) + 16 * f(x + dx, y + dy) - 30 * f(x, y) + 16 * f(x - dx, y - dy) -
            f(x - 2 * dx, y - 2 * dy)) /
           (12 * step * step);
  };
  return {along(step, 0), (along(step, step) - along(step, -step)) / 4, along(0, step)};
}

// Root mean square and greatest difference of two surfaces' power and cylinder, D, within a radius.
struct PowerDifference {
  double power_rms = 0.0, power_max = 0.0, cylinder_rms = 0.0, cylinder_max = 0.0;
};

inline PowerDifference power_difference(const std::function<glm::dvec3(double, double)>& a,
                                        const std::function<glm::dvec3(double, double)>& b, double index,
                                        double radius) {
  PowerDifference result;
  int count = 0;
  constexpr double kStep = 1.3e-3;  // not a divisor of any grid's step
  for (double x = -radius; x <= radius; x += kStep) {
    for (double y = -radius; y <= radius; y += kStep) {
      if (x * x + y * y > radius * radius) continue;
      const glm::dvec3 d = a(x, y) - b(x, y);
      const double power = (index - 1.0) * 0.5 * (d.x + d.z);
      const double cylinder = (index - 1.0) * std::hypot(d.x - d.z, 2.0 * d.y);
      result.power_rms += power * power;
      result.cylinder_rms += cylinder * cylinder;
      result.power_max = std::max(result.power_max, std::abs(power));
      result.cylinder_max = std::max(result.cylinder_max, cylinder);
      ++count;
    }
  }
  result.power_rms = std::sqrt(result.power_rms / count);
  result.cylinder_rms = std::sqrt(result.cylinder_rms / count);
  return result;
}

}  // namespace support
