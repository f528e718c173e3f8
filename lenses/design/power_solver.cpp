#include "lenses/design/power_solver.hpp"

#include <Eigen/Dense>
#include <cmath>

namespace lenses::design {
namespace {

using Vector = Eigen::Matrix<double, 5, 1>;
using Matrix = Eigen::Matrix<double, 5, 5>;

constexpr int kMostSteps = 30;
// Far below what any instrument shows, far above rounding (1e-13 of some ten dioptres).
constexpr double kSettled = 1e-10;
constexpr double kAccepted = 1e-7;
// For derivatives by differences: of a curvature (1/m), a slope or a length (m). The lens is smooth on their scale.
constexpr double kCurvatureStep = 1e-5;
constexpr double kPrismaticStep = 1e-7;

Vector to_vector(const LensUnknowns& u) {
  return {u.curvature[0][0], u.curvature[0][1], u.curvature[1][1], u.prismatic.x, u.prismatic.y};
}

LensUnknowns to_unknowns(const Vector& x) {
  return {glm::dmat2(x[0], x[1], x[1], x[2]), {x[3], x[4]}};
}

class Problem {
 public:
  Problem(const LensMeasure& measure, const PointPower& target, bool with_prism)
      : measure_(measure), target_(target), with_prism_(with_prism) {}

  [[nodiscard]] std::optional<Vector> residual(const Vector& x) const {
    const auto reached = measure_(to_unknowns(x));
    if (!reached) {
      return std::nullopt;
    }
    const glm::dmat2 power = reached->power - target_.power;
    const glm::dvec2 prism = with_prism_ ? reached->prism - target_.prism : glm::dvec2(0.0);
    const Vector r{power[0][0], 0.5 * (power[0][1] + power[1][0]), power[1][1], prism.x, prism.y};
    return r.allFinite() ? std::optional(r) : std::nullopt;
  }

  [[nodiscard]] std::optional<Matrix> derivatives(const Vector& x, const Vector& at_x) const {
    Matrix result = Matrix::Identity();
    for (int i = 0; i < (with_prism_ ? 5 : 3); ++i) {
      const double step = i < 3 ? kCurvatureStep : kPrismaticStep;
      Vector beside = x;
      beside[i] += step;
      const auto r = residual(beside);
      if (!r) {
        return std::nullopt;
      }
      result.col(i) = (*r - at_x) / step;
    }
    return result;
  }

 private:
  const LensMeasure& measure_;
  const PointPower& target_;
  bool with_prism_;
};

}  // namespace

std::optional<LensUnknowns> solve_power(const LensUnknowns& start, const LensMeasure& measure, const PointPower& target,
                                        bool with_prism) {
  // The derivatives hardly change along the way: they are taken anew only when a step gains less than this.
  constexpr double kGain = 0.1;
  const Problem problem(measure, target, with_prism);
  Vector x = to_vector(start);
  auto r = problem.residual(x);
  std::optional<Eigen::FullPivLU<Matrix>> inverse;
  for (int step = 0; r && step < kMostSteps && r->norm() > kSettled; ++step) {
    const bool fresh = !inverse;
    if (fresh) {
      const auto derivatives = problem.derivatives(x, *r);
      if (!derivatives) {
        break;
      }
      inverse.emplace(*derivatives);
    }
    const Vector change = inverse->solve(*r);
    // A step that makes it worse is halved.
    double part = 1.0;
    auto next = problem.residual(x - change);
    for (int half = 0; fresh && half < 12 && !(next && next->norm() < r->norm()); ++half) {
      part *= 0.5;
      next = problem.residual(x - part * change);
    }
    const bool better = next && next->norm() < r->norm();
    if (!better && fresh) {
      break;
    }
    if (!better || next->norm() > kGain * r->norm()) {
      inverse.reset();
    }
    if (better) {
      x -= part * change;
      r = next;
    }
  }
  return r && r->norm() <= kAccepted ? std::optional(to_unknowns(x)) : std::nullopt;
}

}  // namespace lenses::design
