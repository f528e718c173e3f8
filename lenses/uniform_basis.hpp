// Cubic B-splines over equal knot steps: values and derivatives of the four that are not zero at a place.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "lenses/bspline_field.hpp"

namespace lenses {

class UniformBasis {
 public:
  struct Values {
    std::size_t first;  // control that value[0] belongs to
    std::array<double, 4> value;
  };

  // count controls, count - 3 cells between low and high.
  UniformBasis(double low, double high, std::size_t count);

  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] double step() const { return step_; }
  [[nodiscard]] std::vector<double> knots() const;
  [[nodiscard]] Values at(double x) const;
  [[nodiscard]] Values derivative(double x) const;
  [[nodiscard]] Values second_derivative(double x) const;

  // A row a place, a column a control.
  [[nodiscard]] Eigen::MatrixXd design(const std::vector<double>& places) const;
  // Third differences of the controls: rows of D with |D c|^2 = step^5 int s'''^2.
  [[nodiscard]] Eigen::MatrixXd third_differences() const;

 private:
  double low_, step_;
  std::size_t count_;
  BsplineAxis axis_;
};

}  // namespace lenses
