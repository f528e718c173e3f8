#include "lenses/grid_fit.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

namespace lenses {
namespace {

// Modes that less than this part of their matrix sees are not determined by samples.
constexpr double kLeastShare = 1e-13;

// s_xxx and s_yyy weigh alike, whatever the steps and the samples a cell.
double penalty_scale(const UniformBasis& own, const UniformBasis& other, std::size_t samples) {
  const double samples_per_cell = static_cast<double>(samples) / static_cast<double>(own.count() - 3);
  return samples_per_cell * std::pow(std::min(own.step(), other.step()) / own.step(), 6.0);
}

}  // namespace

GridFit::Direction::Direction(UniformBasis basis_in, const std::vector<double>& places, double scale)
    : basis(std::move(basis_in)), design(basis.design(places)) {
  const Eigen::MatrixXd samples = design.transpose() * design;
  const Eigen::MatrixXd differences = basis.third_differences();
  const Eigen::MatrixXd both = samples + scale * differences.transpose() * differences;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(samples, both);
  vectors = solver.eigenvectors();
  share = solver.eigenvalues().array().max(0.0).min(1.0);
}

Eigen::RowVectorXd GridFit::Direction::modes(const UniformBasis::Values& values) const {
  Eigen::RowVectorXd result = Eigen::RowVectorXd::Zero(vectors.cols());
  for (std::size_t i = 0; i < 4; ++i) {
    result += values.value[i] * vectors.row(static_cast<Eigen::Index>(values.first + i));
  }
  return result;
}

GridFit::GridFit(UniformBasis x, UniformBasis y, const std::vector<double>& places_x,
                 const std::vector<double>& places_y, const Eigen::MatrixXd& heights)
    : x_(x, places_x, penalty_scale(x, y, places_x.size())), y_(y, places_y, penalty_scale(y, x, places_y.size())) {
  const Eigen::ArrayXd penalty_x = 1.0 - x_.share, penalty_y = 1.0 - y_.share;
  seen_ = (x_.share.matrix() * y_.share.matrix().transpose()).array();
  penalised_ =
      (penalty_x.matrix() * y_.share.matrix().transpose() + x_.share.matrix() * penalty_y.matrix().transpose()).array();
  moments_ = (x_.vectors.transpose() * (x_.design.transpose() * heights * y_.design) * y_.vectors).array();
  unreachable_ = (heights - x_.design * controls(0.0) * y_.design.transpose()).squaredNorm();
}

Eigen::ArrayXXd GridFit::gain(double weight) const {
  const Eigen::ArrayXXd stiffness = seen_ + weight * penalised_;
  return (seen_ > kLeastShare).select(1.0 / stiffness, 0.0);
}

double GridFit::residual_square(double weight) const {
  const Eigen::ArrayXXd lost = weight * penalised_ * gain(weight);  // part of each mode that the penalty takes away
  const Eigen::ArrayXXd energy = (seen_ > kLeastShare).select(moments_.square() / seen_, 0.0);
  return unreachable_ + (energy * lost.square()).sum();
}

double GridFit::freedom(double weight) const {
  return (seen_ * gain(weight)).sum();
}

Eigen::MatrixXd GridFit::controls(double weight) const {
  return x_.vectors * (moments_ * gain(weight)).matrix() * y_.vectors.transpose();
}

Eigen::Matrix3d GridFit::curvature_covariance(double weight, double at_x, double at_y) const {
  const Eigen::RowVectorXd x0 = x_.modes(x_.basis.at(at_x)), x1 = x_.modes(x_.basis.derivative(at_x)),
                           x2 = x_.modes(x_.basis.second_derivative(at_x));
  const Eigen::RowVectorXd y0 = y_.modes(y_.basis.at(at_y)), y1 = y_.modes(y_.basis.derivative(at_y)),
                           y2 = y_.modes(y_.basis.second_derivative(at_y));
  // In the modes the samples' noise has the covariance seen_, so the fitted modes' is gain^2 seen.
  const Eigen::MatrixXd variance = (gain(weight).square() * seen_).matrix();
  const std::array<std::pair<const Eigen::RowVectorXd*, const Eigen::RowVectorXd*>, 3> derivatives{
      {{&x2, &y0}, {&x1, &y1}, {&x0, &y2}}};
  Eigen::Matrix3d result;
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t b = 0; b < 3; ++b) {
      const Eigen::RowVectorXd along_x = derivatives[a].first->cwiseProduct(*derivatives[b].first);
      const Eigen::RowVectorXd along_y = derivatives[a].second->cwiseProduct(*derivatives[b].second);
      result(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b)) =
          (along_x * variance * along_y.transpose()).value();
    }
  }
  return result;
}

}  // namespace lenses
