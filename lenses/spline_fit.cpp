#include "lenses/spline_fit.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "lenses/grid_fit.hpp"
#include "lenses/scattered_fit.hpp"

namespace lenses {
namespace {

constexpr std::size_t kFewestControls = 12;  // of a net tried, where there are as many samples
constexpr std::size_t kMostScatteredControls = 50;
constexpr std::size_t kMostScatteredSamples = 250000;  // each is 16 entries of a sparse matrix
constexpr double kLeastNoise = 1e-13;                  // m: heights in double precision are no better
constexpr double kSamePlace = 1e-9;                    // m: nearer places are one grid line
constexpr double kLeastWeight = 1e-10, kMostWeight = 1e10;

struct Places {
  std::vector<double> x, y;  // the grid lines, ascending
};

std::vector<double> distinct(const std::vector<glm::dvec3>& points, int axis) {
  std::vector<double> all;
  all.reserve(points.size());
  for (const glm::dvec3& point : points) all.push_back(point[axis]);
  std::ranges::sort(all);
  std::vector<double> result;
  for (const double value : all) {
    if (result.empty() || value - result.back() > kSamePlace) result.push_back(value);
  }
  return result;
}

std::size_t nearest(const std::vector<double>& lines, double value) {
  const auto above = std::ranges::lower_bound(lines, value - kSamePlace);
  return std::min(static_cast<std::size_t>(above - lines.begin()), lines.size() - 1);
}

// The heights as a matrix, when every crossing of the grid lines has its one sample.
std::optional<Eigen::MatrixXd> full_grid(const std::vector<glm::dvec3>& points, const Places& places) {
  if (places.x.size() * places.y.size() != points.size()) return std::nullopt;
  const double missing = std::numeric_limits<double>::quiet_NaN();
  Eigen::MatrixXd heights = Eigen::MatrixXd::Constant(static_cast<Eigen::Index>(places.x.size()),
                                                      static_cast<Eigen::Index>(places.y.size()), missing);
  for (const glm::dvec3& point : points) {
    heights(static_cast<Eigen::Index>(nearest(places.x, point.x)),
            static_cast<Eigen::Index>(nearest(places.y, point.y))) = point.z;
  }
  if (heights.hasNaN()) return std::nullopt;
  return heights;
}

// 1, x, x^2 by 1, y, y^2: what the penalty does not see. Taken out before and put back after the fit, so that sums of
// squares are not differences of large numbers.
struct Trend {
  glm::dvec3 centre{0.0};  // x, y used
  double scale = 1.0;
  Eigen::Matrix3d coefficients = Eigen::Matrix3d::Zero();  // [power of x][power of y]

  [[nodiscard]] double at(double x, double y) const {
    const double u = (x - centre.x) / scale, v = (y - centre.y) / scale;
    return Eigen::RowVector3d(1.0, u, u * u) * coefficients * Eigen::Vector3d(1.0, v, v * v);
  }
};

Trend trend_of(const std::vector<glm::dvec3>& points, const Places& places) {
  Trend trend;
  trend.centre = {0.5 * (places.x.front() + places.x.back()), 0.5 * (places.y.front() + places.y.back()), 0.0};
  trend.scale = 0.5 * std::max(places.x.back() - places.x.front(), places.y.back() - places.y.front());
  Eigen::Matrix<double, 9, 9> normal = Eigen::Matrix<double, 9, 9>::Zero();
  Eigen::Matrix<double, 9, 1> right = Eigen::Matrix<double, 9, 1>::Zero();
  for (const glm::dvec3& point : points) {
    const double u = (point.x - trend.centre.x) / trend.scale, v = (point.y - trend.centre.y) / trend.scale;
    Eigen::Matrix<double, 9, 1> row;
    row << 1.0, v, v * v, u, u * v, u * v * v, u * u, u * u * v, u * u * v * v;
    normal += row * row.transpose();
    right += row * point.z;
  }
  const Eigen::ColPivHouseholderQR<Eigen::Matrix<double, 9, 9>> solver(normal);
  if (solver.rank() < 9) throw std::invalid_argument("the points lie on a curve; a surface needs points all over it");
  const Eigen::Matrix<double, 9, 1> solved = solver.solve(right);
  trend.coefficients = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(solved.data());
  return trend;
}

// Controls of 1, x, x^2 along one direction: at knot mean m they are 1, m and m^2 - step^2/3.
Eigen::MatrixXd power_controls(const UniformBasis& basis, double low, double centre, double scale) {
  Eigen::MatrixXd result(static_cast<Eigen::Index>(basis.count()), 3);
  const double h = basis.step() / scale;
  for (Eigen::Index i = 0; i < result.rows(); ++i) {
    const double m = (low + basis.step() * (static_cast<double>(i) - 1.0) - centre) / scale;
    result.row(i) << 1.0, m, m * m - h * h / 3.0;
  }
  return result;
}

BsplineHeightField height_field(const UniformBasis& x, const UniformBasis& y, const Eigen::MatrixXd& controls,
                                const Places& places, const Trend& trend) {
  const Eigen::MatrixXd all =
      controls + power_controls(x, places.x.front(), trend.centre.x, trend.scale) * trend.coefficients *
                     power_controls(y, places.y.front(), trend.centre.y, trend.scale).transpose();
  BsplineHeightField surface{x.knots(), y.knots(), {}};
  surface.control_z.reserve(x.count() * y.count());
  for (Eigen::Index i = 0; i < all.rows(); ++i) {
    for (Eigen::Index j = 0; j < all.cols(); ++j) surface.control_z.push_back(all(i, j));
  }
  return surface;
}

// The weight of least risk, on a logarithmic scale: a coarse search, since the risk may have several dips, then a fine
// one around the best.
double best_weight(const std::function<double(double)>& risk, double coarse_factor, double fine_factor) {
  const auto search = [&](double low, double high, double factor) {
    double best = low, least = std::numeric_limits<double>::infinity();
    for (double weight = low; weight <= high * 1.0001; weight *= factor) {
      if (const double r = risk(weight); r < least) {
        least = r;
        best = weight;
      }
    }
    return best;
  };
  const double coarse = search(kLeastWeight, kMostWeight, coarse_factor);
  if (fine_factor >= coarse_factor) return coarse;
  return search(coarse / coarse_factor, coarse * coarse_factor, fine_factor);
}

void set_residuals(SplineFit& fit, const UniformBasis& x, const UniformBasis& y, const Eigen::MatrixXd& controls,
                   const std::vector<glm::dvec3>& detrended) {
  double sum = 0.0;
  for (const glm::dvec3& point : detrended) {
    const auto along_x = x.at(point.x), along_y = y.at(point.y);
    double height = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) {
        height += along_x.value[i] * along_y.value[j] *
                  controls(static_cast<Eigen::Index>(along_x.first + i), static_cast<Eigen::Index>(along_y.first + j));
      }
    }
    const double residual = std::abs(point.z - height);
    sum += residual * residual;
    fit.residual_max = std::max(fit.residual_max, residual);
  }
  fit.residual_rms = std::sqrt(sum / static_cast<double>(detrended.size()));
}

// covariance(x, y) is for unit noise; what the net could not follow counts as noise too.
void set_curvature_noise(SplineFit& fit, const Places& places,
                         const std::function<Eigen::Matrix3d(double, double)>& covariance) {
  constexpr int kRings = 3, kSpokes = 8;
  constexpr double kReach = 0.9;
  const glm::dvec2 centre(0.5 * (places.x.front() + places.x.back()), 0.5 * (places.y.front() + places.y.back()));
  const glm::dvec2 half(places.x.back() - centre.x, places.y.back() - centre.y);
  double mean = 0.0, difference = 0.0;
  for (int ring = 0; ring < kRings; ++ring) {
    const double r = kReach * std::sqrt((ring + 0.5) / kRings);  // rings of equal area
    for (int spoke = 0; spoke < kSpokes; ++spoke) {
      const double angle = 2.0 * std::numbers::pi * (spoke + 0.5 * ring) / kSpokes;
      const Eigen::Matrix3d c =
          covariance(centre.x + r * half.x * std::cos(angle), centre.y + r * half.y * std::sin(angle));
      mean += 0.25 * (c(0, 0) + 2.0 * c(0, 2) + c(2, 2));
      difference += c(0, 0) - 2.0 * c(0, 2) + c(2, 2) + 4.0 * c(1, 1);
    }
  }
  const double noise = std::max(fit.noise, fit.residual_rms);
  fit.mean_curvature_noise = noise * std::sqrt(mean / (kRings * kSpokes));
  fit.curvature_difference_noise = noise * std::sqrt(difference / (kRings * kSpokes));
}

struct Problem {
  std::vector<glm::dvec3> detrended;
  Places places;
  Trend trend;
  double noise;
  std::size_t most_controls;

  [[nodiscard]] UniformBasis basis_x(std::size_t count) const { return {places.x.front(), places.x.back(), count}; }
  [[nodiscard]] UniformBasis basis_y(std::size_t count) const { return {places.y.front(), places.y.back(), count}; }
  [[nodiscard]] double samples() const { return static_cast<double>(detrended.size()); }
};

SplineFit fit_grid(const Problem& problem, const Eigen::MatrixXd& heights) {
  const std::size_t most_x = std::min(problem.places.x.size(), problem.most_controls);
  const std::size_t most_y = std::min(problem.places.y.size(), problem.most_controls);
  const double variance = problem.noise * problem.noise;
  // The coarsest net that can follow the samples down to their noise.
  constexpr double kFollows = 1.02;
  std::size_t count = kFewestControls;
  while (true) {
    const std::size_t count_x = std::min(count, most_x), count_y = std::min(count, most_y);
    const UniformBasis x = problem.basis_x(count_x), y = problem.basis_y(count_y);
    const GridFit solver(x, y, problem.places.x, problem.places.y, heights);
    const double spare = problem.samples() - solver.freedom(0.0);
    const bool finest = count_x == most_x && count_y == most_y;
    if (!finest && solver.residual_square(0.0) > kFollows * variance * spare) {
      count = count * 5 / 4;
      continue;
    }
    const double weight = best_weight(
        [&](double w) { return solver.residual_square(w) + 2.0 * variance * solver.freedom(w); }, 10.0, 1.2);
    SplineFit fit;
    const Eigen::MatrixXd controls = solver.controls(weight);
    fit.surface = height_field(x, y, controls, problem.places, problem.trend);
    fit.noise = problem.noise;
    fit.freedom = solver.freedom(weight);
    set_residuals(fit, x, y, controls, problem.detrended);
    set_curvature_noise(fit, problem.places,
                        [&](double px, double py) { return solver.curvature_covariance(weight, px, py); });
    return fit;
  }
}

SplineFit fit_scattered(const Problem& problem) {
  if (problem.detrended.size() > kMostScatteredSamples) {
    throw std::invalid_argument(std::to_string(problem.detrended.size()) +
                                " points are too many where they fill no grid; up to " +
                                std::to_string(kMostScatteredSamples) + " are allowed");
  }
  // About two samples a cell at least, or the penalty alone would shape most of the surface.
  const double width = problem.places.x.back() - problem.places.x.front();
  const double height = problem.places.y.back() - problem.places.y.front();
  const double cell = std::sqrt(2.0 * width * height / problem.samples());
  const auto count_for = [&](double size) {
    const auto cells = static_cast<std::size_t>(std::clamp(std::floor(size / cell), 1.0, 1e6));
    return std::min({cells + 3, kMostScatteredControls, problem.most_controls});
  };
  const UniformBasis x = problem.basis_x(count_for(width)), y = problem.basis_y(count_for(height));
  ScatteredFit solver(x, y, problem.detrended);
  const double variance = problem.noise * problem.noise;
  const double weight = best_weight(
      [&](double w) {
        solver.set_weight(w);
        return solver.residual_square() + 2.0 * variance * solver.freedom();
      },
      100.0, 10.0);
  solver.set_weight(weight);
  SplineFit fit;
  const Eigen::MatrixXd controls = solver.controls();
  fit.surface = height_field(x, y, controls, problem.places, problem.trend);
  fit.noise = problem.noise;
  fit.freedom = solver.freedom();
  set_residuals(fit, x, y, controls, problem.detrended);
  set_curvature_noise(fit, problem.places, [&](double px, double py) { return solver.curvature_covariance(px, py); });
  return fit;
}

}  // namespace

void SplineFitConfig::validate() const {
  if (noise && !(std::isfinite(*noise) && *noise >= 0.0)) {
    throw std::invalid_argument("the noise must be a finite length, 0 or more");
  }
  if (most_controls < 4) throw std::invalid_argument("a bicubic net has at least 4 controls a direction");
}

SplineFit fit_spline(const SagSamples& samples, const SplineFitConfig& config) {
  config.validate();
  Problem problem;
  problem.places = {distinct(samples.points, 0), distinct(samples.points, 1)};
  if (problem.places.x.size() < 4 || problem.places.y.size() < 4) {
    throw std::invalid_argument("at least 4 different places along x and along y are needed");
  }
  problem.trend = trend_of(samples.points, problem.places);
  problem.detrended = samples.points;
  for (glm::dvec3& point : problem.detrended) point.z -= problem.trend.at(point.x, point.y);
  problem.noise = std::max(config.noise.value_or(samples.noise), kLeastNoise);
  problem.most_controls = config.most_controls;
  const auto grid = full_grid(problem.detrended, problem.places);
  SplineFit fit = grid ? fit_grid(problem, *grid) : fit_scattered(problem);
  fit.samples = samples.points.size();
  return fit;
}

}  // namespace lenses
