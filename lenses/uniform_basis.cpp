#include "lenses/uniform_basis.hpp"

#include <algorithm>
#include <cmath>

namespace lenses {

UniformBasis::UniformBasis(double low, double high, std::size_t count)
    : low_(low), step_((high - low) / static_cast<double>(count - 3)), count_(count) {}

std::vector<double> UniformBasis::knots() const {
  std::vector<double> result;
  for (std::size_t i = 0; i < count_ + 4; ++i) result.push_back(low_ + step_ * (static_cast<double>(i) - 3.0));
  return result;
}

UniformBasis::Place UniformBasis::place(double x) const {
  const double along = (x - low_) / step_;
  const double cell = std::clamp(std::floor(along), 0.0, static_cast<double>(count_ - 4));
  return {static_cast<std::size_t>(cell), along - cell};
}

UniformBasis::Values UniformBasis::at(double x) const {
  const auto [cell, t] = place(x);
  const double s = 1.0 - t;
  return {cell,
          {s * s * s / 6.0, (3.0 * t * t * t - 6.0 * t * t + 4.0) / 6.0, (3.0 * s * s * s - 6.0 * s * s + 4.0) / 6.0,
           t * t * t / 6.0}};
}

UniformBasis::Values UniformBasis::derivative(double x) const {
  const auto [cell, t] = place(x);
  const double s = 1.0 - t, scale = 0.5 / step_;
  return {cell, {-s * s * scale, (3.0 * t * t - 4.0 * t) * scale, (4.0 * s - 3.0 * s * s) * scale, t * t * scale}};
}

UniformBasis::Values UniformBasis::second_derivative(double x) const {
  const auto [cell, t] = place(x);
  const double scale = 1.0 / (step_ * step_);
  return {cell, {(1.0 - t) * scale, (3.0 * t - 2.0) * scale, (1.0 - 3.0 * t) * scale, t * scale}};
}

Eigen::MatrixXd UniformBasis::design(const std::vector<double>& places) const {
  Eigen::MatrixXd result =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(places.size()), static_cast<Eigen::Index>(count_));
  for (std::size_t k = 0; k < places.size(); ++k) {
    const Values values = at(places[k]);
    for (std::size_t i = 0; i < 4; ++i) {
      result(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(values.first + i)) = values.value[i];
    }
  }
  return result;
}

Eigen::MatrixXd UniformBasis::third_differences() const {
  const auto rows = static_cast<Eigen::Index>(count_ - 3);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(rows, static_cast<Eigen::Index>(count_));
  for (Eigen::Index i = 0; i < rows; ++i) result.block<1, 4>(i, i) << -1.0, 3.0, -3.0, 1.0;
  return result;
}

}  // namespace lenses
