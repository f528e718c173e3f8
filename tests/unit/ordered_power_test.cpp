#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "lenses/design/materials.hpp"
#include "lenses/design/ordered_power.hpp"
#include "lenses/design/prism_base.hpp"

namespace {

namespace design = lenses::design;
using lenses::Prescription;

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180.0;
constexpr double kRounding = 1e-12;  // of some ten dioptres

void expect_same(const glm::dmat2& a, const glm::dmat2& b, double within = kRounding) {
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      EXPECT_NEAR(a[i][j], b[i][j], within);
    }
  }
}

// The examiner's axis of 30 degrees is the wearer's 150: power of the sphere along it.
TEST(OrderedPower, MirrorsTheExaminersAxis) {
  const glm::dmat2 power = design::power_matrix(-2.0, -1.5, 30.0 * kDegree);
  const glm::dvec2 axis(std::cos(150.0 * kDegree), std::sin(150.0 * kDegree));
  const glm::dvec2 across(-axis.y, axis.x);
  EXPECT_NEAR(dot(axis, power * axis), -2.0, kRounding);
  EXPECT_NEAR(dot(across, power * across), -3.5, kRounding);
  EXPECT_NEAR(dot(axis, power * across), 0.0, kRounding);
}

// M = S + C/2, J0 = -(C/2) cos 2A, J45 = -(C/2) sin 2A (Thibos, Wheeler, Horner 1997), in the examiner's axes.
TEST(OrderedPower, AgreesWithPowerVectors) {
  for (const double degrees : {5.0, 45.0, 90.0, 137.0, 180.0}) {
    const double s = 1.25;
    const double c = -2.5;
    const double a = degrees * kDegree;
    const glm::dmat2 power = design::power_matrix(s, c, a);
    EXPECT_NEAR(0.5 * (power[0][0] + power[1][1]), s + 0.5 * c, kRounding);
    EXPECT_NEAR(0.5 * (power[0][0] - power[1][1]), -0.5 * c * std::cos(2.0 * a), kRounding);
    EXPECT_NEAR(power[0][1], 0.5 * c * std::sin(2.0 * a), kRounding) << "mirrored: the sign of J45 turns";
  }
}

TEST(OrderedPower, TransposedPrescriptionsAreOneLens) {
  expect_same(design::power_matrix(2.0, -3.0, 20.0 * kDegree), design::power_matrix(-1.0, 3.0, 110.0 * kDegree));
}

TEST(OrderedPower, GoesBackToWords) {
  constexpr unsigned kSeed = 11;
  std::mt19937 random(kSeed);
  const auto uniform = [&](double lo, double hi) { return std::uniform_real_distribution(lo, hi)(random); };
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + " round " + std::to_string(i));
    Prescription p{uniform(-20.0, 15.0), uniform(0.25, 6.0), uniform(1e-3, kPi), 0.0, {{uniform(0.1, 10.0), 0.0}}};
    p.prism[0].base = uniform(0.0, 2.0 * kPi);
    p.cylinder *= i % 2 == 0 ? 1.0 : -1.0;
    const Prescription q = design::to_prescription(design::ordered_power(p), p.cylinder > 0.0);
    EXPECT_NEAR(q.sphere, p.sphere, kRounding);
    EXPECT_NEAR(q.cylinder, p.cylinder, kRounding);
    EXPECT_NEAR(q.axis, p.axis, 1e-10);  // rounding over the smallest cylinder
    ASSERT_EQ(q.prism.size(), 1U);
    EXPECT_NEAR(q.prism[0].magnitude, p.prism[0].magnitude, kRounding);
    EXPECT_NEAR(q.prism[0].base, p.prism[0].base, 1e-10);
  }
}

TEST(OrderedPower, WritesAxis180NotZeroAndLeavesOutWhatIsNot) {
  const Prescription level = design::to_prescription({design::power_matrix(1.0, -2.0, 0.0), {}}, false);
  EXPECT_NEAR(level.axis, kPi, kRounding);
  EXPECT_TRUE(level.prism.empty());
  const Prescription round = design::to_prescription({design::power_matrix(1.0, 0.0, 0.3), {}}, false);
  EXPECT_EQ(round.cylinder, 0.0);
  EXPECT_EQ(round.axis, 0.0);
}

// F / (1 - d F) in each meridian.
TEST(OrderedPower, ChangesVertexMeridianByMeridian) {
  const double d = 0.013;
  const glm::dmat2 moved = design::nearer_to_eye(design::power_matrix(-8.0, -4.0, 25.0 * kDegree), d);
  const double s = -8.0 / (1.0 + 8.0 * d);
  const double both = -12.0 / (1.0 + 12.0 * d);
  expect_same(moved, design::power_matrix(s, both - s, 25.0 * kDegree));
}

// In is towards the nose: a right eye's nose is at the wearer's left, the examiner's right (0 degrees).
TEST(PrismBases, InIsTowardsTheNose) {
  using lenses::PrismBase;
  const auto towards = [](PrismBase base, lenses::Side side) {
    const std::vector<lenses::Prism> prisms{{1.0, lenses::base_angle(base, side)}};
    return design::prism_vector(prisms);
  };
  const auto expect = [](const glm::dvec2& v, double x, double y) {
    EXPECT_NEAR(v.x, x, kRounding);
    EXPECT_NEAR(v.y, y, kRounding);
  };
  expect(towards(PrismBase::in, lenses::Side::right), -1.0, 0.0);
  expect(towards(PrismBase::in, lenses::Side::left), 1.0, 0.0);
  expect(towards(PrismBase::out, lenses::Side::right), 1.0, 0.0);
  expect(towards(PrismBase::out, lenses::Side::left), -1.0, 0.0);
  expect(towards(PrismBase::up, lenses::Side::right), 0.0, 1.0);
  expect(towards(PrismBase::down, lenses::Side::left), 0.0, -1.0);
}

TEST(PrismBases, PrismsAddAsVectors) {
  const std::vector<lenses::Prism> prisms{{3.0, 0.0}, {4.0, 0.5 * kPi}};
  const glm::dvec2 sum = design::prism_vector(prisms);
  EXPECT_NEAR(std::hypot(sum.x, sum.y), 5.0, kRounding);
}

TEST(Materials, AreFoundByName) {
  ASSERT_NE(lenses::find_material("polycarbonate"), nullptr);
  EXPECT_EQ(lenses::find_material("polycarbonate")->index, 1.586);
  EXPECT_EQ(lenses::find_material("polycarbonate")->abbe, 30.0);
  EXPECT_EQ(lenses::find_material("MR-174")->index, 1.740);
  EXPECT_EQ(lenses::find_material("glass"), nullptr);
  EXPECT_EQ(lenses::materials().size(), 8U);
}

}  // namespace
