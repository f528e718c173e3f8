#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "lenses/bspline.hpp"
#include "lenses/lens_check.hpp"
#include "lenses/surface_model.hpp"

namespace lenses {
namespace {

class NetError {
 public:
  explicit NetError(const BsplineHeightField& surface)
      : x_(cells_of(surface.knots_x).breaks), y_(cells_of(surface.knots_y).breaks) {
    data_ = make_surface(surface, Placement{}, 0.1, table_);
  }

  // Largest h |jump of a third derivative| / 12 at cell borders within the radius, 1/m.
  [[nodiscard]] double largest(double radius) const {
    double result = 0.0;
    for (const bool along_x : {true, false}) {
      const std::vector<double>&along = along_x ? x_ : y_, &across = along_x ? y_ : x_;
      for (std::size_t j = 0; j + 1 < across.size(); ++j) {
        const double middle = 0.5 * (across[j] + across[j + 1]);
        for (std::size_t i = 1; i + 1 < along.size(); ++i) {
          if (std::hypot(along[i], middle) > radius) continue;
          const double before = third_derivative(along_x, along[i - 1], along[i], middle);
          const double after = third_derivative(along_x, along[i], along[i + 1], middle);
          const double step = 0.5 * (along[i + 1] - along[i - 1]);
          result = std::max(result, step * std::abs(after - before) / 12.0);
        }
      }
    }
    return result;
  }

 private:
  // Constant within a cell along its own direction.
  [[nodiscard]] double third_derivative(bool along_x, double from, double to, double across) const {
    const double inset = 0.25 * (to - from);
    const auto second = [&](double at) {
      const glm::dvec2 place = along_x ? glm::dvec2(at, across) : glm::dvec2(across, at);
      const glm::dvec3 hessian = f64::surface_point(f64::Table{table_}, data_, place).hessian;
      return along_x ? hessian.x : hessian.z;
    };
    return (second(to - inset) - second(from + inset)) / (to - from - 2.0 * inset);
  }

  std::vector<double> x_, y_;
  std::vector<glm::dvec4> table_;
  f64::SurfaceData data_{};
};

}  // namespace

double net_error(const BsplineHeightField& surface, double index, double radius) {
  return (index - 1.0) * NetError(surface).largest(radius);
}

}  // namespace lenses
