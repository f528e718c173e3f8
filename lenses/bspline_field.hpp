// Bicubic B-spline height fields on the host: basis functions along an axis, height and derivatives at a point, and the
// net that follows a given function.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "lenses/bspline.hpp"
#include "lenses/lens.hpp"

namespace lenses {

// The four basis functions that are not zero at a place, with their first and second derivatives.
struct BasisAt {
  std::size_t first;  // control point of the first of them
  std::array<double, 4> value, slope, bend;
};

class BsplineAxis {
 public:
  explicit BsplineAxis(std::span<const double> knots);
  // Beyond the ends the end cells' polynomials go on.
  [[nodiscard]] BasisAt at(double x) const;

 private:
  Cells cells_;
  std::vector<std::array<std::array<double, 4>, 4>> basis_;
};

struct HeightPoint {
  double z;             // m
  glm::dvec2 gradient;  // z_x, z_y
  glm::dvec3 hessian;   // z_xx, z_xy, z_yy, 1/m
};

// Of the net control[i * count_y + j], i along x.
[[nodiscard]] HeightPoint height_point(const BasisAt& x, const BasisAt& y, std::span<const double> control,
                                       std::size_t count_y);

// Keeps a pointer to the net, which must outlive it.
class HeightFieldReader {
 public:
  explicit HeightFieldReader(const BsplineHeightField& field);
  [[nodiscard]] HeightPoint at(const glm::dvec2& p) const;

 private:
  const BsplineHeightField* field_;
  BsplineAxis x_, y_;
};

// Uniform knots for `count` control points, the outermost cells ending at +- half_width.
[[nodiscard]] std::vector<double> uniform_knots(std::size_t count, double half_width);

// Least squares to a function over the square of +- half_width, `count` control points along each axis.
[[nodiscard]] BsplineHeightField fit_height_field(const std::function<double(double x, double y)>& height,
                                                  std::size_t count, double half_width);

// The surface mirrored in x (the other eye's lens); the knots along x must be symmetric about 0.
[[nodiscard]] BsplineHeightField mirrored(const BsplineHeightField& field);

}  // namespace lenses
