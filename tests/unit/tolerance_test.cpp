// ANSI Z80.1-2015 as printed in its tables of tolerances, at both sides of every edge, and verdicts by it.
#include <gtest/gtest.h>

#include <cmath>

#include "lenses/measure/power.hpp"
#include "lenses/measure/tolerance.hpp"
#include "tests/support/random_lens.hpp"

namespace {

using lenses::Check;
using lenses::LensClass;
using lenses::LensReadings;
using lenses::LensSide;
using lenses::Order;
using lenses::Prescription;
using lenses::ReferencePoint;
using lenses::tolerance_limit;
using support::kRadians;

const lenses::ToleranceStandard& ansi() {
  return *lenses::find_standard("ANSI Z80.1-2015");
}

TEST(Standard, IsFoundByItsLettersAndDigits) {
  EXPECT_EQ(lenses::find_standard("ansi-z80.1-2015"), &ansi());
  EXPECT_EQ(lenses::find_standard("ansi_z80_1_2015"), &ansi());
  EXPECT_EQ(lenses::find_standard("ANSI Z80.1-2020"), nullptr);
  EXPECT_EQ(lenses::find_standard(""), nullptr);
  EXPECT_EQ(&lenses::tolerance_standards().front(), &ansi());
}

TEST(Ansi2015, BandsHaveTheirEdges) {
  const auto sphere = [](LensClass c, double d) { return tolerance_limit(ansi().sphere[static_cast<int>(c)], d); };
  const auto cylinder = [](LensClass c, double d) { return tolerance_limit(ansi().cylinder[static_cast<int>(c)], d); };
  for (const LensClass c : {LensClass::single_vision, LensClass::multifocal}) {
    EXPECT_EQ(sphere(c, 0.0), 0.13);
    EXPECT_EQ(sphere(c, -6.50), 0.13);
    EXPECT_NEAR(sphere(c, 6.51), 0.1302, 1e-12);
    EXPECT_NEAR(sphere(c, -20.0), 0.40, 1e-12);
    EXPECT_EQ(cylinder(c, -2.00), 0.13);
    EXPECT_EQ(cylinder(c, -2.01), 0.15);
    EXPECT_EQ(cylinder(c, -4.50), 0.15);
    EXPECT_NEAR(cylinder(c, -4.51), 0.1804, 1e-12);
  }
  const LensClass p = LensClass::progressive;
  EXPECT_EQ(sphere(p, 8.00), 0.16);
  EXPECT_NEAR(sphere(p, -8.01), 0.1602, 1e-12);
  EXPECT_EQ(cylinder(p, -2.00), 0.16);
  EXPECT_EQ(cylinder(p, -2.01), 0.18);
  EXPECT_EQ(cylinder(p, -3.50), 0.18);
  EXPECT_NEAR(cylinder(p, -3.51), 0.1755, 1e-12);
  const double axis[][2] = {{0.12, 14}, {0.25, 14}, {0.26, 7}, {0.50, 7}, {0.51, 5},
                            {0.75, 5},  {0.76, 3},  {1.50, 3}, {1.51, 2}, {6.0, 2}};
  for (const auto& [power, degrees] : axis) {
    EXPECT_EQ(tolerance_limit(ansi().axis, power), degrees) << power;
  }
  EXPECT_EQ(tolerance_limit(ansi().addition, 4.00), 0.12);
  EXPECT_EQ(tolerance_limit(ansi().addition, 4.01), 0.18);
}

LensReadings readings_of(const Prescription& rx) {
  LensReadings readings;
  lenses::LensmeterReading reading;
  reading.status = lenses::RayStatus::ok;
  reading.power = lenses::power_matrix({rx.sphere, rx.cylinder, rx.axis});
  reading.prism = lenses::prism_vector(rx.prism);
  readings.points = {{ReferencePoint::distance, LensSide::back, glm::dvec2(0.0), reading},
                     {ReferencePoint::prism, LensSide::back, glm::dvec2(0.0), reading}};
  if (rx.addition != 0.0) {
    readings.addition = rx.addition;
  }
  return readings;
}

std::vector<Check> checks(const Prescription& measured, const Prescription& ordered,
                          LensClass lens_class = LensClass::single_vision) {
  return judge(ansi(), lens_class, readings_of(measured), {ordered, std::nullopt}).checks;
}

const Check& of(const std::vector<Check>& all, const std::string& tolerance) {
  const auto found = std::ranges::find(all, tolerance, &Check::tolerance);
  EXPECT_NE(found, all.end()) << tolerance;
  return *found;
}

TEST(Verdict, ALimitReachedPassesAndALimitPassedFails) {
  const Prescription order{.sphere = -3.0, .cylinder = -1.0, .axis = 90 * kRadians, .addition = 0.0, .prism = {}};
  for (const double sign : {-1.0, 1.0}) {
    Prescription lens = order;
    lens.sphere += sign * 0.13;
    EXPECT_TRUE(of(checks(lens, order), "sphere").pass);
    lens.sphere += sign * 0.0001;
    EXPECT_FALSE(of(checks(lens, order), "sphere").pass);
    EXPECT_TRUE(of(checks(lens, order), "cylinder").pass);
    lens = order;
    lens.cylinder += sign * 0.1301;
    EXPECT_FALSE(of(checks(lens, order), "cylinder").pass);
    lens = order;
    lens.axis += sign * 3.0 * kRadians;
    EXPECT_TRUE(of(checks(lens, order), "axis").pass);
    lens.axis += sign * 0.01 * kRadians;
    EXPECT_FALSE(of(checks(lens, order), "axis").pass);
  }
}

TEST(Verdict, EitherFormOfTheOrderIsTheSameOrder) {
  const Prescription minus{-2.0, -1.5, 30 * kRadians, 0.0, {}}, plus{-3.5, 1.5, 120 * kRadians, 0.0, {}};
  const auto a = checks(minus, minus), b = checks(plus, plus), c = checks(minus, plus);
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_TRUE(c[i].pass);
    EXPECT_NEAR(a[i].target, b[i].target, 1e-12);
    EXPECT_NEAR(*a[i].measured, *c[i].measured, 1e-12);
  }
}

TEST(Verdict, AxesAreComparedAcrossTheHalfTurn) {
  const Prescription order{0.0, -2.0, 179 * kRadians, 0.0, {}};
  Prescription lens = order;
  lens.axis = 1 * kRadians;
  const Check axis = of(checks(lens, order), "axis");
  EXPECT_NEAR(*axis.difference, 2.0, 1e-9);
  EXPECT_TRUE(axis.pass);
}

TEST(Verdict, ACylinderBelowAnEighthHasNoAxisToJudge) {
  const Prescription order{0.0, -0.11, 45 * kRadians, 0.0, {}};
  const auto all = checks(order, order);
  EXPECT_EQ(std::ranges::count(all, "axis", &Check::tolerance), 0);
}

TEST(Verdict, PrismIsRightToAThirdOrWithinAMillimetre) {
  Prescription order{.sphere = 0.0, .cylinder = 0.0, .axis = 0.0, .addition = 0.0, .prism = {{2.0, 0.0}}};
  Prescription lens = order;
  lens.prism = {{2.0, 0.0}, {0.33, 90 * kRadians}};
  EXPECT_TRUE(of(checks(lens, order), "prism").pass);
  lens.prism[1].magnitude = 0.331;
  EXPECT_FALSE(of(checks(lens, order), "prism").pass) << "without power a millimetre changes nothing";
  order.sphere = lens.sphere = -6.0;  // Prentice: 0.6 prism dioptres a millimetre
  EXPECT_TRUE(of(checks(lens, order), "prism").pass);
  lens.prism[1].magnitude = 0.601;
  const Check prism = of(checks(lens, order), "prism");
  EXPECT_FALSE(prism.pass);
  EXPECT_NEAR(prism.limit, 0.6, 1e-9);
  EXPECT_NEAR(*prism.difference, 0.601, 1e-9);
  // Along a plano cylinder's axis no millimetre helps; across it 1 mm is worth 0.4.
  order = {.sphere = 0.0, .cylinder = -4.0, .axis = 180 * kRadians, .addition = 0.0, .prism = {}};
  lens = order;
  lens.prism = {{0.39, 90 * kRadians}};
  EXPECT_TRUE(of(checks(lens, order), "prism").pass);
  lens.prism = {{0.39, 0.0}};
  EXPECT_FALSE(of(checks(lens, order), "prism").pass);
}

TEST(Verdict, AMountedPairsVerticalImbalance) {
  const Prescription ordered{-2.0, 0.0, 0.0, 0.0, {{1.0, 90 * kRadians}}}, other{-6.0, 0.0, 0.0, 0.0, {}};
  Prescription lens = ordered;
  lens.prism[0].magnitude = 1.33;
  const auto check = [&](const Prescription& made, const Prescription& partner) {
    return *vertical_imbalance(ansi(), readings_of(made), Order{ordered, std::nullopt}, readings_of(partner),
                               Order{other, std::nullopt});
  };
  EXPECT_NEAR(check(lens, other).target, 1.0, 1e-12) << "what was ordered is no imbalance";
  EXPECT_TRUE(check(lens, other).pass);
  Prescription partner = other;
  partner.prism = {{0.01, 270 * kRadians}};  // the other way: both add
  EXPECT_FALSE(check(lens, partner).pass);
  partner.prism = {{5.0, 180 * kRadians}};
  EXPECT_TRUE(check(lens, partner).pass) << "horizontal prism is none of it";
  EXPECT_FALSE(vertical_imbalance(ansi(), readings_of(lens), std::nullopt, readings_of(other), Order{other, {}}));
}

TEST(Verdict, IsAgainstTheCompensatedPowerWhereThereIsOne) {
  const Prescription ordered{-4.0, 0.0, 0.0, 2.0, {}}, compensated{-3.7, -0.25, 90 * kRadians, 1.9, {}};
  const Order order{ordered, compensated};
  const auto verdict = judge(ansi(), LensClass::progressive, readings_of(compensated), order);
  EXPECT_TRUE(verdict.against_compensated);
  EXPECT_TRUE(verdict.pass());
  EXPECT_EQ(verdict.standard, "ANSI Z80.1-2015");
  EXPECT_FALSE(judge(ansi(), LensClass::progressive, readings_of(ordered), order).pass());
  EXPECT_TRUE(judge(ansi(), LensClass::progressive, readings_of(ordered), {ordered, std::nullopt}).pass());
}

TEST(Verdict, AnAdditionThatCannotBeReadIsNoPass) {
  const Prescription order{0.0, 0.0, 0.0, 2.0, {}};
  Prescription lens = order;
  lens.addition = 0.0;  // no near point
  const auto verdict = judge(ansi(), LensClass::single_vision, readings_of(lens), {order, std::nullopt});
  EXPECT_FALSE(verdict.pass());
  EXPECT_FALSE(of(verdict.checks, "addition").measured.has_value());
  EXPECT_TRUE(of(verdict.checks, "sphere").pass);
}

}  // namespace
