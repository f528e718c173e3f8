// Cubic B-splines evaluated by de Boor's recursion on the control points (de Boor 1978), independently of the power
// basis that the tracers read; and splines that equal a paraboloid exactly.
#pragma once

#include <array>
#include <vector>

#include "lenses/lens.hpp"
#include "tests/support/random_lens.hpp"

namespace support {

// The interval of positive width that holds x: knots[k] <= x < knots[k + 1], the last one closed.
inline std::size_t knot_interval(const std::vector<double>& knots, double x) {
  std::size_t k = 3;
  for (std::size_t i = 3; i + 4 < knots.size(); ++i) {
    if (knots[i + 1] > knots[i] && x >= knots[i]) {
      k = i;
    }
  }
  return k;
}

template <class Control>
double de_boor(const std::vector<double>& knots, const Control& control, double x) {
  const std::size_t k = knot_interval(knots, x);
  std::array<double, 4> d{};
  for (std::size_t j = 0; j < 4; ++j) {
    d[j] = control(k - 3 + j);
  }
  for (std::size_t r = 1; r < 4; ++r) {
    for (std::size_t j = 3; j >= r; --j) {
      const double low = knots[k - 3 + j];
      const double a = (x - low) / (knots[k + 1 + j - r] - low);
      d[j] = (1.0 - a) * d[j - 1] + a * d[j];
    }
  }
  return d[3];
}

template <class Control>
double de_boor(const std::vector<double>& knots_u, const std::vector<double>& knots_v, const Control& control, double u,
               double v) {
  return de_boor(
      knots_u,
      [&](std::size_t i) {
        return de_boor(
            knots_v, [&](std::size_t j) { return control(i, j); }, v);
      },
      u);
}

inline double height_at(const lenses::BsplineHeightField& s, double x, double y) {
  return de_boor(
      s.knots_x, s.knots_y, [&](std::size_t i, std::size_t j) { return s.control_z[i * s.count_y() + j]; }, x, y);
}

// Control value i of the spline that equals t^2 (its blossom).
inline double square_control(const std::vector<double>& knots, std::size_t i) {
  return (knots[i + 1] * knots[i + 2] + knots[i + 1] * knots[i + 3] + knots[i + 2] * knots[i + 3]) / 3.0;
}

// z = curvature (x^2 + y^2) / 2, exactly.
inline lenses::BsplineHeightField paraboloid(const std::vector<double>& knots_x, const std::vector<double>& knots_y,
                                             double curvature) {
  lenses::BsplineHeightField spline{knots_x, knots_y, {}};
  for (std::size_t i = 0; i < spline.count_x(); ++i) {
    for (std::size_t j = 0; j < spline.count_y(); ++j) {
      spline.control_z.push_back(0.5 * curvature * (square_control(knots_x, i) + square_control(knots_y, j)));
    }
  }
  return spline;
}

// The same as a parametric patch: x = u + v/4, y = v - u/8.
inline lenses::BsplineSurface parametric_paraboloid(const std::vector<double>& knots_u,
                                                    const std::vector<double>& knots_v, double curvature) {
  lenses::BsplineSurface patch{knots_u, knots_v, {}};
  for (std::size_t i = 0; i < patch.count_u(); ++i) {
    for (std::size_t j = 0; j < patch.count_v(); ++j) {
      const double u = greville(knots_u, i);
      const double v = greville(knots_v, j);
      const double x2 = square_control(knots_u, i) + 0.5 * u * v + square_control(knots_v, j) / 16.0;
      const double y2 = square_control(knots_v, j) - 0.25 * u * v + square_control(knots_u, i) / 64.0;
      patch.control.emplace_back(u + 0.25 * v, v - 0.125 * u, 0.5 * curvature * (x2 + y2));
    }
  }
  return patch;
}

}  // namespace support
