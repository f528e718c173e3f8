#include "lenses/bspline_field.hpp"

#include <Eigen/Dense>
#include <algorithm>

namespace lenses {

BsplineAxis::BsplineAxis(std::span<const double> knots) : cells_(cells_of(knots)) {
  for (std::size_t cell = 0; cell < cells_.count(); ++cell) basis_.push_back(cell_basis(knots, cells_, cell));
}

BasisAt BsplineAxis::at(double x) const {
  const auto above = std::upper_bound(cells_.breaks.begin() + 1, cells_.breaks.end() - 1, x);
  const auto cell = static_cast<std::size_t>(above - cells_.breaks.begin() - 1);
  const double scale = 1.0 / (cells_.breaks[cell + 1] - cells_.breaks[cell]);
  const double s = (x - cells_.breaks[cell]) * scale;
  BasisAt result{cells_.first_control[cell], {}, {}, {}};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& c = basis_[cell][i];
    result.value[i] = ((c[3] * s + c[2]) * s + c[1]) * s + c[0];
    result.slope[i] = ((3.0 * c[3] * s + 2.0 * c[2]) * s + c[1]) * scale;
    result.bend[i] = (6.0 * c[3] * s + 2.0 * c[2]) * scale * scale;
  }
  return result;
}

HeightPoint height_point(const BasisAt& x, const BasisAt& y, std::span<const double> control, std::size_t count_y) {
  HeightPoint point{0.0, glm::dvec2(0.0), glm::dvec3(0.0)};
  for (std::size_t i = 0; i < 4; ++i) {
    const double* row = &control[(x.first + i) * count_y + y.first];
    double value = 0.0, slope = 0.0, bend = 0.0;
    for (std::size_t j = 0; j < 4; ++j) {
      value += y.value[j] * row[j];
      slope += y.slope[j] * row[j];
      bend += y.bend[j] * row[j];
    }
    point.z += x.value[i] * value;
    point.gradient += glm::dvec2(x.slope[i] * value, x.value[i] * slope);
    point.hessian += glm::dvec3(x.bend[i] * value, x.slope[i] * slope, x.value[i] * bend);
  }
  return point;
}

HeightFieldReader::HeightFieldReader(const BsplineHeightField& field)
    : field_(&field), x_(field.knots_x), y_(field.knots_y) {}

HeightPoint HeightFieldReader::at(const glm::dvec2& p) const {
  return height_point(x_.at(p.x), y_.at(p.y), field_->control_z, field_->count_y());
}

std::vector<double> uniform_knots(std::size_t count, double half_width) {
  std::vector<double> knots;
  const double step = 2.0 * half_width / static_cast<double>(count - 3);
  for (std::size_t i = 0; i < count + 4; ++i) knots.push_back(-half_width + step * (static_cast<double>(i) - 3.0));
  return knots;
}

BsplineHeightField fit_height_field(const std::function<double(double x, double y)>& height, std::size_t count,
                                    double half_width) {
  BsplineHeightField field;
  field.knots_x = field.knots_y = uniform_knots(count, half_width);
  const BsplineAxis axis(field.knots_x);
  // Three samples a cell over-determine the net without letting its border swing.
  const auto sites = static_cast<Eigen::Index>(3 * (count - 3) + 1);
  const auto size = static_cast<Eigen::Index>(count);
  const auto site = [&](Eigen::Index k) {
    return -half_width + 2.0 * half_width * static_cast<double>(k) / static_cast<double>(sites - 1);
  };
  Eigen::MatrixXd design = Eigen::MatrixXd::Zero(sites, size), samples(sites, sites);
  for (Eigen::Index k = 0; k < sites; ++k) {
    const BasisAt basis = axis.at(site(k));
    for (std::size_t i = 0; i < 4; ++i) design(k, static_cast<Eigen::Index>(basis.first + i)) = basis.value[i];
    for (Eigen::Index l = 0; l < sites; ++l) samples(k, l) = height(site(k), site(l));
  }
  // The tensor product separates: fit along x for every y site, then along y.
  const Eigen::HouseholderQR<Eigen::MatrixXd> solver(design);
  const Eigen::MatrixXd along_x = solver.solve(samples);
  const Eigen::MatrixXd control = solver.solve(along_x.transpose()).transpose();
  field.control_z.resize(count * count);
  for (Eigen::Index i = 0; i < size; ++i) {
    for (Eigen::Index j = 0; j < size; ++j) field.control_z[static_cast<std::size_t>(i * size + j)] = control(i, j);
  }
  return field;
}

BsplineHeightField mirrored(const BsplineHeightField& field) {
  BsplineHeightField result = field;
  const std::size_t rows = field.count_x(), length = field.count_y();
  for (std::size_t i = 0; i < rows; ++i) {
    std::copy_n(field.control_z.begin() + static_cast<std::ptrdiff_t>((rows - 1 - i) * length), length,
                result.control_z.begin() + static_cast<std::ptrdiff_t>(i * length));
  }
  return result;
}

}  // namespace lenses
