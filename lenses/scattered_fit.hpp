// The penalised least squares of a spline to heights at any places, by a sparse Cholesky factorisation a weight.
#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <glm/vec3.hpp>
#include <vector>

#include "lenses/uniform_basis.hpp"

namespace lenses {

class ScatteredFit {
 public:
  ScatteredFit(UniformBasis x, UniformBasis y, const std::vector<glm::dvec3>& points);

  void set_weight(double weight);  // must come before anything below
  [[nodiscard]] double residual_square() const;
  [[nodiscard]] double freedom() const;  // Hutchinson's estimate of the trace, with probes of a fixed seed
  [[nodiscard]] Eigen::MatrixXd controls() const;
  [[nodiscard]] Eigen::Matrix3d curvature_covariance(double at_x, double at_y) const;

 private:
  using Sparse = Eigen::SparseMatrix<double>;
  [[nodiscard]] Eigen::VectorXd functional(const UniformBasis::Values& x, const UniformBasis::Values& y) const;

  UniformBasis x_, y_;
  Sparse design_, samples_, penalty_;
  Eigen::VectorXd heights_, moments_;
  Eigen::SimplicialLDLT<Sparse> factor_;
  Eigen::VectorXd solution_;
};

}  // namespace lenses
