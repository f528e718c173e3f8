#include "lenses/design/height_field_solver.hpp"

#include <Eigen/SparseCholesky>
#include <cmath>

#include "lenses/design/surface_power.hpp"

namespace lenses {
namespace {

// Height (m) and slope at the centre that cost as much as 1 D at one site. Shifts change nothing else and tilts little,
// so that these prices hold the centre to a small part of a picometre and of a nanoradian.
constexpr double kPinnedHeight = 1e-6, kPinnedSlope = 1e-6;

std::vector<double> gauss_points(std::span<const double> knots) {
  const Cells cells = cells_of(knots);
  const double offset = 0.5 / std::sqrt(3.0);
  std::vector<double> points;
  for (std::size_t i = 0; i < cells.count(); ++i) {
    const double a = cells.breaks[i], b = cells.breaks[i + 1];
    points.push_back(0.5 * (a + b) - offset * (b - a));
    points.push_back(0.5 * (a + b) + offset * (b - a));
  }
  return points;
}

// z_x, z_y, z_xx, z_xy, z_yy of the 16 basis functions, coefficient by coefficient.
std::array<std::array<double, 16>, 5> basis_derivatives(const BasisAt& x, const BasisAt& y) {
  std::array<std::array<double, 16>, 5> d;
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t b = 0; b < 4; ++b) {
      const std::size_t k = 4 * a + b;
      d[0][k] = x.slope[a] * y.value[b];
      d[1][k] = x.value[a] * y.slope[b];
      d[2][k] = x.bend[a] * y.value[b];
      d[3][k] = x.slope[a] * y.slope[b];
      d[4][k] = x.value[a] * y.bend[b];
    }
  }
  return d;
}

// The coefficients' normal equations, lower triangle.
class NormalEquations {
 public:
  NormalEquations(const BsplineHeightField& surface)
      : row_length_(surface.count_y()),
        right_(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(surface.control_z.size()))) {
    triplets_.reserve(136 * row_length_ * surface.count_x());
  }

  // Rows that share the cell whose first coefficients are given.
  template <typename Rows>
  void add(const Rows& rows, std::size_t first_x, std::size_t first_y) {
    for (std::size_t k = 0; k < 16; ++k) {
      const int at_k = index(first_x, first_y, k);
      for (const auto& row : rows) right_[at_k] -= row.by_coefficient[k] * row.residual;
      for (std::size_t l = 0; l <= k; ++l) {
        double sum = 0.0;
        for (const auto& row : rows) sum += row.by_coefficient[k] * row.by_coefficient[l];
        triplets_.emplace_back(at_k, index(first_x, first_y, l), sum);
      }
    }
  }

  [[nodiscard]] std::vector<double> solution() const {
    Eigen::SparseMatrix<double> matrix(right_.size(), right_.size());
    matrix.setFromTriplets(triplets_.begin(), triplets_.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> solver(matrix);
    if (solver.info() != Eigen::Success) return {};
    const Eigen::VectorXd x = solver.solve(right_);
    return {x.begin(), x.end()};
  }

 private:
  [[nodiscard]] int index(std::size_t first_x, std::size_t first_y, std::size_t k) const {
    return static_cast<int>((first_x + k / 4) * row_length_ + first_y + k % 4);
  }

  std::size_t row_length_;
  Eigen::VectorXd right_;
  std::vector<Eigen::Triplet<double>> triplets_;
};

}  // namespace

HeightFieldSolver::HeightFieldSolver(BsplineHeightField start, double power_per_curvature)
    : surface_(std::move(start)), factor_(power_per_curvature) {
  const BsplineAxis x(surface_.knots_x), y(surface_.knots_y);
  const std::vector<double> places_x = gauss_points(surface_.knots_x), places_y = gauss_points(surface_.knots_y);
  for (const double at : places_x) along_x_.push_back(x.at(at));
  for (const double at : places_y) along_y_.push_back(y.at(at));
  for (const double at_x : places_x) {
    for (const double at_y : places_y) sites_.push_back({.place = {at_x, at_y}});
  }
  centre_x_ = x.at(0.0);
  centre_y_ = y.at(0.0);
}

HeightPoint HeightFieldSolver::point(std::size_t i, std::size_t j, std::span<const double> control) const {
  return height_point(along_x_[i], along_y_[j], control, surface_.count_y());
}

std::array<HeightFieldSolver::Row, 3> HeightFieldSolver::rows(std::size_t i, std::size_t j) const {
  const DesignSite& site = sites_[i * along_y_.size() + j];
  const HeightPoint at = point(i, j, surface_.control_z);
  const SurfaceCurvature curvature = surface_curvature(at);
  const CurvatureGradient gradient = curvature_gradient(at);
  const auto basis = basis_derivatives(along_x_[i], along_y_[j]);
  const auto row = [&](double weight, double value, double wanted, const std::array<double, 5>& by_derivative) {
    const double scale = std::sqrt(weight);
    Row result{scale * (factor_ * value - wanted), {}};
    for (std::size_t k = 0; k < 16; ++k) {
      double sum = 0.0;
      for (std::size_t d = 0; d < 5; ++d) sum += by_derivative[d] * basis[d][k];
      result.by_coefficient[k] = scale * factor_ * sum;
    }
    return result;
  };
  return {row(site.power_weight, curvature.mean, site.power, gradient.mean),
          row(site.cylinder_weight, curvature.plus, 0.0, gradient.plus),
          row(site.cylinder_weight, curvature.cross, 0.0, gradient.cross)};
}

std::array<HeightFieldSolver::Row, 3> HeightFieldSolver::pins(std::span<const double> control) const {
  const HeightPoint at = height_point(centre_x_, centre_y_, control, surface_.count_y());
  std::array<Row, 3> result{Row{at.z / kPinnedHeight, {}}, Row{at.gradient.x / kPinnedSlope, {}},
                            Row{at.gradient.y / kPinnedSlope, {}}};
  for (std::size_t k = 0; k < 16; ++k) {
    const double x = centre_x_.value[k / 4], y = centre_y_.value[k % 4];
    result[0].by_coefficient[k] = x * y / kPinnedHeight;
    result[1].by_coefficient[k] = centre_x_.slope[k / 4] * y / kPinnedSlope;
    result[2].by_coefficient[k] = x * centre_y_.slope[k % 4] / kPinnedSlope;
  }
  return result;
}

double HeightFieldSolver::cost_of(std::span<const double> control) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < along_x_.size(); ++i) {
    for (std::size_t j = 0; j < along_y_.size(); ++j) {
      const DesignSite& site = sites_[i * along_y_.size() + j];
      const SurfaceCurvature c = surface_curvature(point(i, j, control));
      const double miss = factor_ * c.mean - site.power;
      sum += site.power_weight * miss * miss +
             site.cylinder_weight * factor_ * factor_ * (c.plus * c.plus + c.cross * c.cross);
    }
  }
  for (const Row& pin : pins(control)) sum += pin.residual * pin.residual;
  return sum;
}

std::vector<double> HeightFieldSolver::direction() const {
  NormalEquations equations(surface_);
  std::vector<Row> cell;
  for (std::size_t i = 0; i < along_x_.size(); i += 2) {
    for (std::size_t j = 0; j < along_y_.size(); j += 2) {
      cell.clear();
      for (std::size_t k = 0; k < 4; ++k) {
        for (const Row& row : rows(i + k / 2, j + k % 2)) cell.push_back(row);
      }
      equations.add(cell, along_x_[i].first, along_y_[j].first);
    }
  }
  equations.add(pins(surface_.control_z), centre_x_.first, centre_y_.first);
  return equations.solution();
}

double HeightFieldSolver::step() {
  const double before = cost();
  const std::vector<double> by = direction();
  if (by.empty()) return 0.0;
  constexpr int kHalvings = 6;
  double length = 1.0;
  for (int i = 0; i < kHalvings; ++i, length *= 0.5) {
    std::vector<double> control = surface_.control_z;
    for (std::size_t k = 0; k < control.size(); ++k) control[k] += length * by[k];
    const double after = cost_of(control);
    if (after < before) {
      surface_.control_z = std::move(control);
      return (before - after) / before;
    }
  }
  return 0.0;
}

}  // namespace lenses
