#include "lenses/uniform_basis.hpp"

namespace lenses {

UniformBasis::UniformBasis(double low, double high, std::size_t count)
    : low_(low), step_((high - low) / static_cast<double>(count - 3)), count_(count), axis_(knots()) {}

std::vector<double> UniformBasis::knots() const {
  std::vector<double> result;
  for (std::size_t i = 0; i < count_ + 4; ++i) result.push_back(low_ + step_ * (static_cast<double>(i) - 3.0));
  return result;
}

UniformBasis::Values UniformBasis::at(double x) const {
  const BasisAt basis = axis_.at(x);
  return {basis.first, basis.value};
}

UniformBasis::Values UniformBasis::derivative(double x) const {
  const BasisAt basis = axis_.at(x);
  return {basis.first, basis.slope};
}

UniformBasis::Values UniformBasis::second_derivative(double x) const {
  const BasisAt basis = axis_.at(x);
  return {basis.first, basis.bend};
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
