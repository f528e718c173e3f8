#include "lenses/design/surface_power.hpp"

#include <cmath>

namespace lenses {
namespace {

// With a = z_x, b = z_y: first fundamental form E = 1 + a^2, F = a b, G = 1 + b^2, and w^2 = E G - F^2.
struct Forms {
  double a, b, xx, xy, yy, e, g, w2, w;
  double mean, first, cross;  // mean curvature, curvature over the x axis, k_xy

  explicit Forms(const HeightPoint& p)
      : a(p.gradient.x),
        b(p.gradient.y),
        xx(p.hessian.x),
        xy(p.hessian.y),
        yy(p.hessian.z),
        e(1.0 + a * a),
        g(1.0 + b * b),
        w2(1.0 + a * a + b * b),
        w(std::sqrt(w2)),
        mean(0.5 * (e * yy - 2.0 * a * b * xy + g * xx) / (w2 * w)),
        first(xx / (w * e)),
        cross((xy * e - xx * a * b) / (e * w2)) {}
};

}  // namespace

double SurfaceCurvature::difference() const {
  return std::hypot(plus, cross);
}

SurfaceCurvature surface_curvature(const HeightPoint& point) {
  const Forms f(point);
  return {f.mean, 2.0 * (f.first - f.mean), 2.0 * f.cross};
}

CurvatureGradient curvature_gradient(const HeightPoint& point) {
  const Forms f(point);
  const double w3 = f.w2 * f.w;
  CurvatureGradient d;
  d.mean = {(f.a * f.yy - f.b * f.xy) / w3 - 3.0 * f.a * f.mean / f.w2,
            (f.b * f.xx - f.a * f.xy) / w3 - 3.0 * f.b * f.mean / f.w2, 0.5 * f.g / w3, -f.a * f.b / w3,
            0.5 * f.e / w3};
  const std::array<double, 5> first{-f.first * f.a * (1.0 / f.w2 + 2.0 / f.e), -f.first * f.b / f.w2, 1.0 / (f.w * f.e),
                                    0.0, 0.0};
  const double ew2 = f.e * f.w2;
  const std::array<double, 5> cross{
      (2.0 * f.a * f.xy - f.b * f.xx) / ew2 - 2.0 * f.a * f.cross * (1.0 / f.e + 1.0 / f.w2),
      -f.a * f.xx / ew2 - 2.0 * f.b * f.cross / f.w2, -f.a * f.b / ew2, 1.0 / f.w2, 0.0};
  for (std::size_t i = 0; i < 5; ++i) {
    d.plus[i] = 2.0 * (first[i] - d.mean[i]);
    d.cross[i] = 2.0 * cross[i];
  }
  return d;
}

}  // namespace lenses
