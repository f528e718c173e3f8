#include "lenses/scattered_fit.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

namespace lenses {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

// What keeps controls that no sample and no difference reaches determined; far below any sample's share.
constexpr double kRidge = 1e-14;

Eigen::SparseMatrix<double> tensor_design(const UniformBasis& x, const UniformBasis& y,
                                          const std::vector<glm::dvec3>& points) {
  Triplets entries;
  entries.reserve(16 * points.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto along_x = x.at(points[k].x), along_y = y.at(points[k].y);
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) {
        entries.emplace_back(static_cast<int>(k), static_cast<int>((along_x.first + i) * y.count() + along_y.first + j),
                             along_x.value[i] * along_y.value[j]);
      }
    }
  }
  Eigen::SparseMatrix<double> design(static_cast<Eigen::Index>(points.size()),
                                     static_cast<Eigen::Index>(x.count() * y.count()));
  design.setFromTriplets(entries.begin(), entries.end());
  return design;
}

// D^T D of the third differences along both directions, s_xxx and s_yyy weighing alike whatever the steps.
Eigen::SparseMatrix<double> tensor_penalty(const UniformBasis& x, const UniformBasis& y) {
  const std::array<double, 4> difference{-1.0, 3.0, -3.0, 1.0};
  const double least = std::min(x.step(), y.step());
  Triplets entries;
  const auto add = [&](std::size_t start, std::size_t stride, double scale) {
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t b = 0; b < 4; ++b) {
        entries.emplace_back(static_cast<int>(start + a * stride), static_cast<int>(start + b * stride),
                             scale * difference[a] * difference[b]);
      }
    }
  };
  for (std::size_t i = 0; i < x.count(); ++i) {
    for (std::size_t j = 0; j < y.count(); ++j) {
      const std::size_t at = i * y.count() + j;
      if (i + 3 < x.count()) add(at, y.count(), std::pow(least / x.step(), 6.0));
      if (j + 3 < y.count()) add(at, 1, std::pow(least / y.step(), 6.0));
    }
  }
  const auto size = static_cast<Eigen::Index>(x.count() * y.count());
  Eigen::SparseMatrix<double> penalty(size, size);
  penalty.setFromTriplets(entries.begin(), entries.end());
  return penalty;
}

}  // namespace

ScatteredFit::ScatteredFit(UniformBasis x, UniformBasis y, const std::vector<glm::dvec3>& points)
    : x_(x), y_(y), design_(tensor_design(x, y, points)), penalty_(tensor_penalty(x, y)) {
  samples_ = design_.transpose() * design_;
  heights_.resize(static_cast<Eigen::Index>(points.size()));
  for (std::size_t k = 0; k < points.size(); ++k) heights_(static_cast<Eigen::Index>(k)) = points[k].z;
  moments_ = design_.transpose() * heights_;
  Sparse pattern = samples_ + penalty_;
  for (Eigen::Index i = 0; i < pattern.rows(); ++i) pattern.coeffRef(i, i) += kRidge;
  factor_.analyzePattern(pattern);
}

void ScatteredFit::set_weight(double weight) {
  Sparse matrix = samples_ + weight * penalty_;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) matrix.coeffRef(i, i) += kRidge;
  factor_.factorize(matrix);
  if (factor_.info() != Eigen::Success) throw std::invalid_argument("the points do not determine a surface");
  solution_ = factor_.solve(moments_);
}

double ScatteredFit::residual_square() const {
  return (heights_ - design_ * solution_).squaredNorm();
}

double ScatteredFit::freedom() const {
  constexpr int kProbes = 8;
  std::mt19937 random(7);
  double sum = 0.0;
  for (int probe = 0; probe < kProbes; ++probe) {
    Eigen::VectorXd signs(heights_.size());
    for (double& sign : signs) sign = (random() & 1U) != 0 ? 1.0 : -1.0;
    const Eigen::VectorXd seen = design_.transpose() * signs;
    sum += seen.dot(factor_.solve(seen));
  }
  return sum / kProbes;
}

Eigen::MatrixXd ScatteredFit::controls() const {
  const auto rows = static_cast<Eigen::Index>(x_.count()), columns = static_cast<Eigen::Index>(y_.count());
  return Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(solution_.data(),
                                                                                                  rows, columns);
}

Eigen::VectorXd ScatteredFit::functional(const UniformBasis::Values& x, const UniformBasis::Values& y) const {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(moments_.size());
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      result(static_cast<Eigen::Index>((x.first + i) * y_.count() + y.first + j)) = x.value[i] * y.value[j];
    }
  }
  return result;
}

Eigen::Matrix3d ScatteredFit::curvature_covariance(double at_x, double at_y) const {
  Eigen::MatrixXd derivatives(moments_.size(), 3);
  derivatives.col(0) = functional(x_.second_derivative(at_x), y_.at(at_y));
  derivatives.col(1) = functional(x_.derivative(at_x), y_.derivative(at_y));
  derivatives.col(2) = functional(x_.at(at_x), y_.second_derivative(at_y));
  const Eigen::MatrixXd solved = factor_.solve(derivatives);
  return solved.transpose() * (samples_ * solved);
}

}  // namespace lenses
