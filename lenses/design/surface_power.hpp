// Curvature of a height field at a point, from its fundamental forms (do Carmo 1976, 3.3), and how it changes with the
// field's derivatives.
#pragma once

#include <array>

#include "lenses/bspline_field.hpp"

namespace lenses {

// The three numbers that a symmetric curvature matrix has, in the orthonormal tangent basis whose first vector lies
// over the x axis: smooth everywhere, unlike the principal curvatures.
struct SurfaceCurvature {
  double mean = 0.0;                        // (k1 + k2) / 2, 1/m
  double plus = 0.0;                        // (k_xx - k_yy): difference of the curvatures over the axes
  double cross = 0.0;                       // 2 k_xy
  [[nodiscard]] double difference() const;  // |k1 - k2|
};

[[nodiscard]] SurfaceCurvature surface_curvature(const HeightPoint& point);

// Derivatives of mean, plus and cross by z_x, z_y, z_xx, z_xy, z_yy.
struct CurvatureGradient {
  std::array<double, 5> mean, plus, cross;
};

[[nodiscard]] CurvatureGradient curvature_gradient(const HeightPoint& point);

}  // namespace lenses
