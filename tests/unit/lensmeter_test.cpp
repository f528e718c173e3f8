// The lensmeter against closed forms: thick lenses, torics, exact Snell refraction at a point off the centre, lenses
// turned over, and the closed-form progressive.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lenses/lens_io/lens_io.hpp"
#include "lenses/measure/lensmeter.hpp"
#include "lenses/measure/power.hpp"
#include "lenses/measure/readings.hpp"
#include "lenses/measure/thickness.hpp"
#include "tests/support/absurd_lens.hpp"
#include "tests/support/random_lens.hpp"

namespace {

using lenses::CylinderForm;
using lenses::Lens;
using lenses::Lensmeter;
using lenses::LensmeterReading;
using lenses::LensSide;
using lenses::RayStatus;
using lenses::Refraction;
using support::kRadians;

constexpr double kExact = 1e-10;  // D; powers of tens of dioptres in double precision

Lens lens_of(double index, double thickness, lenses::Surface front, lenses::Surface back) {
  Lens lens;
  lens.index = index;
  lens.centre_thickness = thickness;
  lens.diameter = 0.07;
  lens.front = std::move(front);
  lens.back = std::move(back);
  return lens;
}

// Front power f1 and back vertex powers of two meridians, the first along `tabo`.
Lens toric_lens(double f1, double along, double across, double tabo) {
  Lens lens = lens_of(1.6, 0.004, lenses::Sphere{f1 / 0.6}, lenses::Plane{});
  const double at_back = f1 / (1.0 - lens.centre_thickness * f1 / lens.index);
  lens.back = lenses::Torus{(along - at_back) / -0.6, (across - at_back) / -0.6, (180.0 - tabo) * kRadians, {}};
  return lens;
}

TEST(Lensmeter, ThickLensHasTheVertexPowersOfTheTextbook) {
  for (const double f1 : {0.0, 4.0, 18.0}) {
    for (const double f2 : {-16.0, -3.0, 0.0, 5.0}) {
      const double n = 1.7, t = 0.009;
      const Lens lens = lens_of(n, t, lenses::Sphere{f1 / (n - 1)}, lenses::Sphere{f2 / (1 - n)});
      const Lensmeter meter(lens);
      const LensmeterReading back = meter.read(LensSide::back, glm::dvec2(0.0));
      ASSERT_EQ(back.status, RayStatus::ok);
      const Refraction found = sphere_cylinder(back.power, CylinderForm::minus);
      EXPECT_NEAR(found.sphere, f1 / (1 - t * f1 / n) + f2, kExact);
      EXPECT_NEAR(found.cylinder, 0.0, kExact);
      const LensmeterReading front = meter.read(LensSide::front, glm::dvec2(0.0));
      ASSERT_EQ(front.status, RayStatus::ok);
      EXPECT_NEAR(lenses::mean_power(front.power), f2 / (1 - t * f2 / n) + f1, kExact);
      EXPECT_NEAR(lenses::astigmatism(front.power), 0.0, kExact);
    }
  }
}

TEST(Lensmeter, ToricLensReadsAsOrderedInEitherForm) {
  for (double axis = 7.5; axis <= 180.0; axis += 7.5) {
    const Lensmeter meter(toric_lens(6.0, -1.0, -3.5, axis));
    const LensmeterReading reading = meter.read(LensSide::back, glm::dvec2(0.0));
    const Refraction minus = sphere_cylinder(reading.power, CylinderForm::minus);
    EXPECT_NEAR(minus.sphere, -1.0, kExact);
    EXPECT_NEAR(minus.cylinder, -2.5, kExact);
    EXPECT_NEAR(minus.axis / kRadians, axis, 1e-8);
    const Refraction plus = sphere_cylinder(reading.power, CylinderForm::plus);
    EXPECT_NEAR(plus.sphere, -3.5, kExact);
    EXPECT_NEAR(plus.cylinder, 2.5, kExact);
    EXPECT_NEAR(plus.axis / kRadians, axis > 90.0 ? axis - 90.0 : axis + 90.0, 1e-8);
    for (const Refraction& form : {minus, plus}) {
      const glm::dvec3 matrix = lenses::power_matrix(form);
      EXPECT_NEAR(matrix.x, reading.power.x, kExact);
      EXPECT_NEAR(matrix.y, reading.power.y, kExact);
      EXPECT_NEAR(matrix.z, reading.power.z, kExact);
    }
  }
}

TEST(Lensmeter, APrismsBaseIsTheExaminersAndItsVectorTheWearers) {
  for (double base = 0.0; base < 360.0; base += 30.0) {
    const lenses::Prism prism{2.5, base * kRadians};
    const glm::dvec2 vector = lenses::prism_vector(std::span(&prism, 1));
    EXPECT_NEAR(vector.y, 2.5 * std::sin(base * kRadians), 1e-14);
    EXPECT_NEAR(vector.x, -2.5 * std::cos(base * kRadians), 1e-14) << "the examiner faces the wearer";
    const lenses::Prism again = lenses::to_prism(vector);
    EXPECT_NEAR(again.magnitude, 2.5, 1e-14);
    EXPECT_NEAR(std::remainder(again.base - prism.base, 2.0 * std::numbers::pi), 0.0, 1e-14);
    EXPECT_GE(again.base, 0.0);
    EXPECT_LT(again.base, 2.0 * std::numbers::pi);
  }
}

// With a plane back the beam is parallel to the axis and meets the front sphere at sin i = h c.
TEST(Lensmeter, PrismOffTheCentreIsSnellsAndNearThePrenticeRule) {
  const double index = 1.5;
  for (const double power : {8.0, -6.0}) {
    const double c = power / (index - 1.0);
    const Lensmeter meter(lens_of(index, 0.012, lenses::Sphere{c}, lenses::Plane{}));
    for (const double angle : {0.0, 40.0, 130.0, 200.0, 290.0}) {
      const double h = 0.012;
      const glm::dvec2 away(std::cos(angle * kRadians), std::sin(angle * kRadians));
      const LensmeterReading reading = meter.read(LensSide::back, h * away);
      ASSERT_EQ(reading.status, RayStatus::ok);
      const double incidence = std::asin(h * c);
      const double deviation = std::asin(index * std::sin(incidence)) - incidence;
      // A plus lens has its base towards the centre, a minus lens away from it.
      EXPECT_NEAR(reading.prism.x, -100.0 * std::tan(deviation) * away.x, 1e-10);
      EXPECT_NEAR(reading.prism.y, -100.0 * std::tan(deviation) * away.y, 1e-10);
      // P = c F, c in cm; 12 mm off the axis of a sphere of 62 mm Snell's law is 6 % from it.
      EXPECT_NEAR(glm::length(reading.prism) / (100.0 * h * std::abs(power)), 1.0, 0.07);
    }
  }
}

TEST(Lensmeter, OffTheCentreThePowersAreCoddingtons) {
  const double index = 1.5, c = 16.0, h = 0.015;
  const Lensmeter meter(lens_of(index, 0.012, lenses::Sphere{c}, lenses::Plane{}));
  const LensmeterReading reading = meter.read(LensSide::back, {0.0, h});
  const double in = std::asin(h * c), out = std::asin(index * std::sin(in));  // in glass, in air
  const double bend = (index * std::cos(in) - std::cos(out)) * c;
  // Collimated light from the scene; the glass between front and plane back, and the plane itself at normal incidence.
  const double path = 0.012 - (1.0 - std::sqrt(1.0 - h * h * c * c)) / c;
  const auto at_back = [&](double in_glass) { return in_glass / (1.0 - path / index * in_glass); };
  EXPECT_NEAR(reading.power.x, at_back(bend), kExact);                                  // sagittal
  EXPECT_NEAR(reading.power.z, at_back(bend / (std::cos(in) * std::cos(in))), kExact);  // tangential
  EXPECT_NEAR(reading.power.y, 0.0, kExact);
}

// The same lens with its faces swapped, turned about the vertical.
TEST(Lensmeter, TheFrontReadsAsTheBackOfTheLensTurnedOver) {
  support::Random random(20121);
  for (int i = 0; i < 200; ++i) {
    const lenses::Torus front{random.uniform(2.0, 14.0), random.uniform(2.0, 14.0), random.uniform(0.0, 3.1), {}};
    const lenses::Torus back{random.uniform(-4.0, 16.0), random.uniform(-4.0, 16.0), random.uniform(0.0, 3.1), {}};
    const Lens lens = lens_of(1.6, 0.01, front, back);
    const auto over = [](const lenses::Torus& t) {
      return lenses::Torus{-t.curvature_u, -t.curvature_v, std::numbers::pi - t.axis, t.revolve};
    };
    const Lens turned = lens_of(1.6, 0.01, over(back), over(front));
    const glm::dvec2 point(random.uniform(-0.015, 0.015), random.uniform(-0.015, 0.015));
    const LensmeterReading a = Lensmeter(lens).read(LensSide::front, point);
    const LensmeterReading b = Lensmeter(turned).read(LensSide::back, {-point.x, point.y});
    ASSERT_EQ(a.status, RayStatus::ok);
    ASSERT_EQ(b.status, RayStatus::ok);
    EXPECT_NEAR(a.power.x, b.power.x, kExact);
    EXPECT_NEAR(a.power.y, -b.power.y, kExact);
    EXPECT_NEAR(a.power.z, b.power.z, kExact);
    EXPECT_NEAR(a.prism.x, -b.prism.x, kExact);
    EXPECT_NEAR(a.prism.y, b.prism.y, kExact);
    EXPECT_NEAR(a.far_point.x, -b.far_point.x, 1e-14);
    EXPECT_NEAR(a.far_point.y, b.far_point.y, 1e-14);
  }
}

// Behind a plane back collimated light stays so and meets the front at normal incidence: its own power is read.
TEST(Lensmeter, AFrontBeforeAPlaneBackReadsItsOwnPower) {
  support::Random random(77);
  Lens lens = lens_of(1.6, 0.012, lenses::Conic{9.0, -0.6, {4.0, -900.0}}, lenses::Plane{});
  const Lensmeter meter(lens);
  for (int i = 0; i < 50; ++i) {
    const glm::dvec2 point(random.uniform(-0.02, 0.02), random.uniform(-0.02, 0.02));
    const LensmeterReading reading = meter.read(LensSide::front, point);
    ASSERT_EQ(reading.status, RayStatus::ok);
    EXPECT_NEAR(lenses::mean_power(reading.power), *meter.surface_power(LensSide::front, point), kExact);
  }
}

Lens progressive() {
  return lenses::read_lens(VERGENCE_ASSETS "/lenses/progressive_add200_right.json");
}

// The figures of the closed form, which tests/unit/progressive_family_test.cpp has from the formulas: 5.00 D at the
// distance point, 6.995 D at the near point, peak cylinder 2.21 D within 30 mm. The lens file holds the B-spline fit,
// which is within 0.04 D in power and 0.065 D in cylinder of it at worst, far less at the two points.
TEST(Lensmeter, ClosedFormProgressiveHasItsFigures) {
  Lens lens = progressive();
  lens.back = lenses::Plane{};
  lens.centre_thickness = 0.010;
  const Lensmeter meter(lens);
  const auto mean = [&](const glm::dvec2& point) {
    return lenses::mean_power(meter.read(LensSide::front, point).power);
  };
  EXPECT_NEAR(mean(*lens.reference_points.distance), 5.00, 0.01);
  EXPECT_NEAR(mean(*lens.reference_points.near), 6.995, 0.01);
  double peak = 0.0;
  for (double x = -0.030; x <= 0.030; x += 5e-4) {
    for (double y = -0.030; y <= 0.030; y += 5e-4) {
      if (const LensmeterReading reading = meter.read(LensSide::front, {x, y});
          x * x + y * y <= 9e-4 && reading.status == RayStatus::ok) {
        peak = std::max(peak, lenses::astigmatism(reading.power));
      }
    }
  }
  EXPECT_NEAR(peak, 2.21, 0.065);
}

TEST(Readings, ProgressiveIsPlanoAtDistanceAndItsAdditionIsOnTheFront) {
  const Lens lens = progressive();
  const Lensmeter meter(lens);
  const lenses::LensReadings readings = read_lens_powers(lens, meter);
  const auto* distance = readings.find(lenses::ReferencePoint::distance, LensSide::back);
  ASSERT_NE(distance, nullptr);
  const Refraction found = sphere_cylinder(distance->reading.power, CylinderForm::minus);
  // At the vertex it is plano to 0.001 D; 8 mm up, in a beam normal to a back 4 degrees tilted there, to 0.05 D.
  EXPECT_NEAR(found.sphere, 0.0, 0.05);
  EXPECT_NEAR(found.cylinder, 0.0, 0.05);
  EXPECT_EQ(readings.addition_side, LensSide::front);
  ASSERT_TRUE(readings.addition.has_value());
  EXPECT_NEAR(*readings.addition, 1.995, 0.02);  // the back's share changes with the thickness between the two points
  EXPECT_EQ(readings.points.size(), 5U);
}

TEST(Readings, AnAdditionOnTheBackIsReadThere) {
  Lens lens = progressive();
  const lenses::Sphere flat{5.0};
  std::swap(lens.front, lens.back);
  lens.front = flat;
  const lenses::LensReadings readings = read_lens_powers(lens, Lensmeter(lens));
  EXPECT_EQ(readings.addition_side, LensSide::back);
  ASSERT_TRUE(readings.addition.has_value());
  EXPECT_NEAR(*readings.addition, -1.995, 0.05) << "the same surface behind the glass takes power away";
}

TEST(Readings, SingleVisionHasNoAdditionAndIsReadAtItsOrigin) {
  const Lens lens = toric_lens(5.0, 2.0, 1.0, 30.0);
  const lenses::LensReadings readings = read_lens_powers(lens, Lensmeter(lens));
  EXPECT_FALSE(readings.addition.has_value());
  ASSERT_EQ(readings.points.size(), 2U);
  EXPECT_EQ(readings.points[0].at, glm::dvec2(0.0));
  EXPECT_EQ(readings.points[1].at, glm::dvec2(0.0));
}

TEST(Lensmeter, SaysWhyThereIsNoReading) {
  const Lensmeter meter(lens_of(1.5, 0.002, lenses::Sphere{10.0}, lenses::Plane{}));
  EXPECT_EQ(meter.read(LensSide::back, {0.036, 0.0}).status, RayStatus::miss_back) << "beyond the blank";
  EXPECT_EQ(meter.read(LensSide::front, {0.036, 0.0}).status, RayStatus::miss_front);
  EXPECT_EQ(meter.read(LensSide::back, {0.030, 0.0}).status, RayStatus::inverted) << "the surfaces have crossed";
  EXPECT_EQ(meter.read(LensSide::front, {0.030, 0.0}).status, RayStatus::inverted);
  EXPECT_EQ(meter.read(LensSide::back, {0.005, 0.0}).status, RayStatus::ok);
}

// Whatever a file may hold: a status or finite numbers, and an end.
TEST(Lensmeter, AbsurdLensesGiveFiniteReadingsOrAStatus) {
  support::Random random(5);
  int ok = 0;
  for (int i = 0; i < 300; ++i) {
    const Lens lens = support::absurd_lens(random);
    std::optional<Lensmeter> meter;
    try {
      meter.emplace(lens);
    } catch (const std::invalid_argument&) {
      continue;  // a patch that folds over
    }
    static_cast<void>(lenses::edge_thickness(lens, *meter));
    for (int k = 0; k < 20; ++k) {
      const double reach = 0.6 * lens.diameter;
      const glm::dvec2 point(random.uniform(-reach, reach), random.uniform(-reach, reach));
      for (const LensSide side : {LensSide::back, LensSide::front}) {
        const LensmeterReading reading = meter->read(side, point);
        if (reading.status == RayStatus::ok) {
          ++ok;
          EXPECT_TRUE(std::isfinite(reading.power.x + reading.power.y + reading.power.z)) << i;
          EXPECT_TRUE(std::isfinite(reading.prism.x + reading.prism.y)) << i;
        }
      }
    }
  }
  EXPECT_GT(ok, 500);
}

TEST(Thickness, IsTheDifferenceOfTheSags) {
  const double c1 = 12.0, c2 = 4.0;
  Lens lens = lens_of(1.5, 0.009, lenses::Sphere{c1}, lenses::Sphere{c2});
  const Lensmeter meter(lens);
  const auto sag = [](double c, double r) { return (1.0 - std::sqrt(1.0 - c * c * r * r)) / c; };
  for (const double r : {0.0, 0.01, 0.03}) {
    EXPECT_NEAR(*meter.thickness({0.6 * r, -0.8 * r}), 0.009 - sag(c1, r) + sag(c2, r), 1e-16);
  }
  const auto rim = lenses::edge_thickness(lens, meter);
  ASSERT_TRUE(rim.has_value());
  EXPECT_NEAR(rim->least.thickness, 0.009 - sag(c1, 0.035) + sag(c2, 0.035), 2e-6);  // chords of a circle of 1 degree
  // A frame: the far corner of a plus lens is thinnest.
  lens.outline = {{-0.02, -0.01}, {0.015, -0.01}, {0.015, 0.012}, {-0.02, 0.012}};
  const auto edge = lenses::edge_thickness(lens, meter);
  EXPECT_EQ(edge->least.at, glm::dvec2(-0.02, 0.012));
  EXPECT_NEAR(edge->least.thickness, *meter.thickness({-0.02, 0.012}), 1e-16);
  EXPECT_NEAR(edge->greatest.at.x, 0.0, 5e-4);
  EXPECT_EQ(edge->greatest.at.y, -0.01);
}

}  // namespace
