#include "assets/generator/bspline_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>

namespace assets {
namespace {

struct Basis {
  std::size_t first;
  std::array<double, 4> value;
};

// The four uniform cubic B-splines that are not zero at x.
Basis basis_at(const std::vector<double>& knots, double x) {
  const double step = knots[1] - knots[0];
  const auto last = static_cast<double>(knots.size() - 8);
  const double cell = std::clamp(std::floor((x - knots[3]) / step), 0.0, last);
  const double t = (x - knots[3]) / step - cell, s = 1.0 - t;
  return {static_cast<std::size_t>(cell),
          {s * s * s / 6.0, (3.0 * t * t * t - 6.0 * t * t + 4.0) / 6.0, (3.0 * s * s * s - 6.0 * s * s + 4.0) / 6.0,
           t * t * t / 6.0}};
}

}  // namespace

double BsplineNet::height(double x, double y) const {
  const Basis bx = basis_at(knots, x), by = basis_at(knots, y);
  double sum = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      sum += bx.value[i] * by.value[j] * control[(bx.first + i) * count() + by.first + j];
    }
  }
  return sum;
}

BsplineNet fit_bspline(const std::function<double(double x, double y)>& height, std::size_t count, double half_width) {
  BsplineNet net;
  const double step = 2.0 * half_width / static_cast<double>(count - 3);
  for (std::size_t i = 0; i < count + 4; ++i) net.knots.push_back(-half_width + step * (static_cast<double>(i) - 3.0));
  // Three samples a cell over-determine the net without letting its border swing.
  const auto sites = static_cast<Eigen::Index>(3 * (count - 3) + 1);
  const auto size = static_cast<Eigen::Index>(count);
  const auto site = [&](Eigen::Index k) {
    return -half_width + 2.0 * half_width * static_cast<double>(k) / static_cast<double>(sites - 1);
  };
  Eigen::MatrixXd design = Eigen::MatrixXd::Zero(sites, size), samples(sites, sites);
  for (Eigen::Index k = 0; k < sites; ++k) {
    const Basis basis = basis_at(net.knots, site(k));
    for (std::size_t i = 0; i < 4; ++i) design(k, static_cast<Eigen::Index>(basis.first + i)) = basis.value[i];
    for (Eigen::Index l = 0; l < sites; ++l) samples(k, l) = height(site(k), site(l));
  }
  // The tensor product separates: fit along x for every y site, then along y.
  const Eigen::HouseholderQR<Eigen::MatrixXd> solver(design);
  const Eigen::MatrixXd along_x = solver.solve(samples);
  const Eigen::MatrixXd control = solver.solve(along_x.transpose()).transpose();
  net.control.resize(count * count);
  for (Eigen::Index i = 0; i < size; ++i) {
    for (Eigen::Index j = 0; j < size; ++j) net.control[static_cast<std::size_t>(i * size + j)] = control(i, j);
  }
  return net;
}

BsplineNet mirrored(const BsplineNet& net) {
  BsplineNet result = net;
  const std::size_t n = net.count();
  for (std::size_t i = 0; i < n; ++i) {
    std::copy_n(net.control.begin() + static_cast<std::ptrdiff_t>((n - 1 - i) * n), n,
                result.control.begin() + static_cast<std::ptrdiff_t>(i * n));
  }
  return result;
}

}  // namespace assets
