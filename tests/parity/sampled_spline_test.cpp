// B-splines fitted to samples of a plane, a paraboloid and a sphere, traced beside the surface itself on both engines:
// how far off the power is, by the number of control points; and samples as rough as a sag file's.
#include <glm/gtc/constants.hpp>

#include "lenses/bspline_field.hpp"
#include "tests/support/hard_case.hpp"

namespace {

using lenses::RayStatus;
using lenses::TraceRequest;

constexpr double kHalfWidth = 0.035;
constexpr double kCurvature = 12.5;  // 80 mm

lenses::BsplineHeightField sampled(const std::function<double(double, double)>& z, std::size_t count,
                                   double half_width = kHalfWidth) {
  return lenses::fit_height_field(z, count, half_width);
}

double sphere(double x, double y) {
  const double r2 = x * x + y * y;
  return kCurvature * r2 / (1.0 + std::sqrt(1.0 - kCurvature * kCurvature * r2));
}

class SampledSpline : public support::HardCase {
 protected:
  // The largest difference of any component of V between the two backs, for rays to 22 mm from the axis.
  static double difference(const lenses::Surface& one, const lenses::Surface& other) {
    std::vector<TraceRequest> requests;
    for (const auto& back : {one, other}) {
      for (int i = 0; i < 200; ++i) {  // along a spiral, so that no two rays meet a cell at the same place
        const double radius = 22.0 * std::sqrt((i + 0.5) / 200.0);
        const double angle = glm::golden_ratio<double>() * 2.0 * std::numbers::pi * i;
        requests.push_back(
            parallel(through(lenses::Sphere{14.0}, back, 4.0), radius * std::cos(angle), radius * std::sin(angle)));
      }
    }
    const auto results = trace(requests);
    double worst = 0.0;
    for (std::size_t i = 0; i < 200; ++i) {
      EXPECT_EQ(results[i].status, RayStatus::ok);
      EXPECT_EQ(results[200 + i].status, RayStatus::ok);
      const glm::dvec3 d = glm::abs(results[i].vergence - results[200 + i].vergence);
      worst = std::max({worst, d.x, d.y, d.z});
    }
    return worst;
  }
};

// A cubic spline holds both exactly; what is left is the fit's rounding.
TEST_P(SampledSpline, OfAPlaneAndAParaboloidIsExact) {
  const auto paraboloid = [](double x, double y) { return 0.5 * kCurvature * (x * x + y * y); };
  for (const std::size_t count : {8U, 30U}) {
    const double plane_error = difference(sampled([](double, double) { return 0.0; }, count), lenses::Plane{});
    const double error = difference(sampled(paraboloid, count), lenses::Conic{kCurvature, -1.0, {}});
    std::cout << count << ": plane " << plane_error << " D, paraboloid " << error << " D\n";
    EXPECT_LE(plane_error, is_reference() ? 1e-9 : 1e-4);
    EXPECT_LE(error, is_reference() ? 1e-9 : 2e-4);
  }
}

// The second derivative of a cubic spline is off by the square of the cell's width: half as wide, a quarter of the
// error. 8, 16, 32 and 64 cells over 70 mm.
TEST_P(SampledSpline, OfASphereIsOffByTheSquareOfItsCells) {
  struct Stated {
    std::size_t count;
    double dioptres;
  };
  for (const auto& [count, dioptres] : {Stated{11, 0.03}, Stated{19, 8e-3}, Stated{35, 2e-3}, Stated{67, 5e-4}}) {
    const double error = difference(sampled(sphere, count), lenses::Sphere{kCurvature});
    std::cout << count << ": sphere " << error << " D\n";
    EXPECT_LE(error, dioptres + (is_reference() ? 0.0 : 2e-4)) << count;
  }
}

// Heights rounded to 1e-4 mm on a grid of 0.5 mm: their second differences are off by 0.15 D root mean square, the
// power of a spline fitted to them in cells of 1.5 mm by 0.04 D where it is worst.
TEST_P(SampledSpline, OfASagFileRoundedToATenthOfAMicrometre) {
  const auto rounded = [](double x, double y) { return std::round(sphere(x, y) * 1e7) * 1e-7; };
  constexpr double kStep = 0.0005;
  double sum = 0.0;
  int count = 0;
  for (double x = -0.015; x <= 0.015; x += kStep) {
    for (double y = -0.015; y <= 0.015; y += kStep) {
      const auto bend = [&](const auto& z) {
        return (z(x + kStep, y) - 2.0 * z(x, y) + z(x - kStep, y)) / (kStep * kStep);
      };
      const double error = 0.5 * (bend(rounded) - bend(sphere));
      sum += error * error;
      ++count;
    }
  }
  EXPECT_GE(std::sqrt(sum / count), 0.1) << "differenced, the file is of no use";
  // 45 cells of 1.5 mm.
  const double error = difference(sampled(rounded, 48, 45 * 1.5e-3 / 2.0), lenses::Sphere{kCurvature});
  std::cout << "rounded: " << error << " D, differenced " << std::sqrt(sum / count) << " D rms\n";
  EXPECT_LE(error, 0.04);
}

INSTANTIATE_TEST_SUITE_P(Engines, SampledSpline, testing::Values(support::Engine::reference, support::Engine::gpu),
                         support::engine_name);

}  // namespace
