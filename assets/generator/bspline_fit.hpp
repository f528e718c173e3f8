// A bicubic B-spline height field fitted to a function by tensor-product least squares.
#pragma once

#include <functional>
#include <vector>

namespace assets {

// Uniform knots, count + 4 of them in each direction, so that the outermost cells end at +- half_width.
struct BsplineNet {
  std::vector<double> knots;    // m, the same along x and y
  std::vector<double> control;  // m, [i * count + j], i along x
  [[nodiscard]] std::size_t count() const { return knots.size() - 4; }
  [[nodiscard]] double height(double x, double y) const;
};

[[nodiscard]] BsplineNet fit_bspline(const std::function<double(double x, double y)>& height, std::size_t count,
                                     double half_width);

// The net of the surface mirrored in x (the other eye's lens).
[[nodiscard]] BsplineNet mirrored(const BsplineNet& net);

}  // namespace assets
