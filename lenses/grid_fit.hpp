// The penalised least squares of a spline to heights on a full grid, for every weight of the penalty at once: both
// directions are brought to a basis in which the samples' and the penalty's matrices are diagonal together.
#pragma once

#include <Eigen/Core>

#include "lenses/uniform_basis.hpp"

namespace lenses {

class GridFit {
 public:
  // heights(k, l) at places_x[k], places_y[l].
  GridFit(UniformBasis x, UniformBasis y, const std::vector<double>& places_x, const std::vector<double>& places_y,
          const Eigen::MatrixXd& heights);

  [[nodiscard]] double residual_square(double weight) const;  // sum over the samples
  [[nodiscard]] double freedom(double weight) const;          // trace of the matrix from samples to fitted heights
  [[nodiscard]] Eigen::MatrixXd controls(double weight) const;
  // Covariance of (s_xx, s_xy, s_yy) at a place, for samples whose noise has unit variance.
  [[nodiscard]] Eigen::Matrix3d curvature_covariance(double weight, double at_x, double at_y) const;

 private:
  struct Direction {
    Direction(UniformBasis basis, const std::vector<double>& places, double penalty_scale);
    [[nodiscard]] Eigen::RowVectorXd modes(const UniformBasis::Values& values) const;
    UniformBasis basis;
    Eigen::MatrixXd design;
    Eigen::MatrixXd vectors;  // columns: modes
    Eigen::ArrayXd share;     // of the samples' matrix in samples' + penalty's, 0..1
  };
  [[nodiscard]] Eigen::ArrayXXd gain(
      double weight) const;  // 1/(samples' + weight * penalty's), 0 where nothing is seen

  Direction x_, y_;
  Eigen::ArrayXXd seen_, penalised_;  // a mode's share of the samples' matrix and of the penalty
  Eigen::ArrayXXd moments_;           // heights seen through the modes
  double unreachable_ = 0.0;          // residual square at weight 0
};

}  // namespace lenses
