// Powers as worn: the published off-axis table, closed forms on the axis for near objects, and what a map holds.
#include <gtest/gtest.h>

#include <cmath>

#include "lenses/lens_io/lens_io.hpp"
#include "lenses/measure/power.hpp"
#include "lenses/measure/worn_map.hpp"
#include "tests/support/absurd_lens.hpp"
#include "tests/support/random_lens.hpp"

namespace {

using lenses::Eye;
using lenses::Lens;
using lenses::RayStatus;
using lenses::Side;
using lenses::WornLens;
using lenses::WornReading;
using support::kRadians;

struct OffAxis {
  const char* name;
  double back_vertex_power, index, front_power;  // D
  double thickness_mm, rotation_deg;
  double tangential, sagittal;  // D
};

class WornOffAxis : public testing::TestWithParam<OffAxis> {};

Lens meniscus(double index, double thickness, double front_power, double back_vertex_power) {
  Lens lens;
  lens.index = index;
  lens.centre_thickness = thickness;
  lens.diameter = 0.08;
  lens.front = lenses::Sphere{front_power / (index - 1.0)};
  const double at_back = front_power / (1.0 - thickness * front_power / index);
  lens.back = lenses::Sphere{(back_vertex_power - at_back) / (1.0 - index)};
  lens.fit.vertex_distance = 0.0135;  // with the centre of rotation 13.5 mm deep a vertex sphere of 27 mm
  return lens;
}

TEST_P(WornOffAxis, AgreesWithTheTable) {
  const OffAxis& c = GetParam();
  const WornLens worn(meniscus(c.index, 1e-3 * c.thickness_mm, c.front_power, c.back_vertex_power), Side::right, {});
  constexpr double kRounding = 5e-5 + 1e-7;  // of the fourth decimal
  for (const double around : {0.0, 90.0, 180.0, 270.0}) {
    const double turn = c.rotation_deg * kRadians;
    const glm::dvec3 gaze(std::sin(turn) * std::cos(around * kRadians), std::sin(turn) * std::sin(around * kRadians),
                          -std::cos(turn));
    const WornReading reading = worn.read(gaze, 0.0);
    ASSERT_EQ(reading.status, RayStatus::ok);
    const bool sideways = around == 0.0 || around == 180.0;
    EXPECT_NEAR(sideways ? reading.power.x : reading.power.z, c.tangential, kRounding);
    EXPECT_NEAR(sideways ? reading.power.z : reading.power.x, c.sagittal, kRounding);
    EXPECT_NEAR(reading.power.y, 0.0, 1e-10);
  }
}

INSTANTIATE_TEST_SUITE_P(Lenses, WornOffAxis,
                         testing::Values(OffAxis{"minus_5", -5.0, 1.498, 3.0, 2.0, 30.0, -5.0317, -4.8879},
                                         OffAxis{"plus_4", 4.0, 1.498, 8.0, 4.5, 30.0, 4.0364, 3.8684},
                                         OffAxis{"minus_8", -8.0, 1.666, 1.5, 1.2, 25.0, -8.4167, -7.9670},
                                         OffAxis{"plus_6", 6.0, 1.586, 9.0, 6.0, 25.0, 6.3435, 5.9435}),
                         [](const auto& instance) { return std::string(instance.param.name); });

TEST(WornLens, NearObjectOnTheAxis) {
  const double index = 1.6, t = 0.005, f1 = 9.0;
  const Lens lens = meniscus(index, t, f1, 4.0);
  const double f2 = 4.0 - f1 / (1.0 - t * f1 / index);
  const WornLens worn(lens, Side::left, {});
  for (const double distance : {0.1, 0.4, 5.0}) {
    // Vergence through the lens surface by surface; the object's distance counts from the back vertex.
    const double in_glass = -1.0 / (distance - t) + f1;
    const double behind = in_glass / (1.0 - t / index * in_glass) + f2;
    const WornReading reading = worn.read({0.0, 0.0, -1.0}, 1.0 / distance);
    ASSERT_EQ(reading.status, RayStatus::ok);
    EXPECT_NEAR(reading.power.x, behind + 1.0 / distance, 1e-10);
    EXPECT_NEAR(reading.power.z, behind + 1.0 / distance, 1e-10);
  }
  EXPECT_EQ(worn.read({0.0, 0.0, -1.0}, 1.0 / 0.004).status, RayStatus::singular) << "an object inside the glass";
}

TEST(WornLens, GazeThroughAPointMeetsThePoint) {
  support::Random random(4711);
  for (int i = 0; i < 100; ++i) {
    const Lens lens = support::ordinary_lens(random);
    const WornLens worn(lens, random.chance(0.5) ? Side::right : Side::left, {});
    const glm::dvec2 point(random.uniform(-0.012, 0.012), random.uniform(-0.012, 0.012));
    const WornReading reading = worn.read(worn.gaze_through(point), 0.0);
    if (reading.status == RayStatus::miss_front && (std::holds_alternative<lenses::SegmentedSurface>(lens.front) ||
                                                    std::holds_alternative<lenses::SegmentedSurface>(lens.back))) {
      continue;  // into the wall of a segment
    }
    ASSERT_EQ(reading.status, RayStatus::ok);
    EXPECT_NEAR(reading.back_point.x, point.x, 1e-9);
    EXPECT_NEAR(reading.back_point.y, point.y, 1e-9);
  }
}

TEST(WornLens, AbsurdLensesGiveFiniteReadingsOrAStatus) {
  support::Random random(6);
  for (int i = 0; i < 100; ++i) {
    const Lens lens = support::absurd_lens(random);
    try {
      const lenses::WornMap map = worn_map(lens, Side::left, {}, {.points = 5, .working_distance = 0.1});
      for (const auto& reading : map.readings) {
        for (const WornReading& r : {reading.far, reading.working}) {
          EXPECT_TRUE(r.status != RayStatus::ok || std::isfinite(r.power.x + r.power.y + r.power.z)) << i;
          EXPECT_TRUE(r.status != RayStatus::ok || std::isfinite(r.prism.x + r.prism.y)) << i;
        }
      }
    } catch (const std::invalid_argument&) {  // a patch that folds over
    }
  }
}

TEST(WornLens, DeviatesTowardsTheBase) {
  // Through the upper part of a plus lens the line of sight bends down to the thick middle: base down.
  const WornReading up = WornLens(meniscus(1.5, 0.005, 8.0, 4.0), Side::right, {}).read({0.0, 0.3, -0.9539392014}, 0.0);
  EXPECT_LT(up.prism.y, -1.0);
  EXPECT_NEAR(up.prism.x, 0.0, 1e-10);
}

TEST(WornMap, WorkingDistanceRunsFromInfinityAtTheCrossToTheNearGaze) {
  const Lens lens = lenses::read_lens(std::string(VERGENCE_ASSETS) + "/lenses/progressive_add200_right.json");
  const lenses::WornMap map = worn_map(lens, Side::right, {}, {.points = 41, .working_distance = 0.4});
  EXPECT_NEAR(map.far_pitch, 0.0, 1e-9) << "the fitting cross is before the pupil";
  EXPECT_NEAR(map.near_pitch / kRadians, -30.0, 3.0);
  ASSERT_EQ(map.readings.size(), 41U * 41U);
  double last = 10.0;
  for (std::size_t row = 0; row < map.grid.rows; ++row) {
    const std::size_t i = row * map.grid.columns + 20;
    const auto& reading = map.readings[i];
    const double pitch = map.grid.at(i).y;
    EXPECT_LE(reading.object_vergence, last);
    last = reading.object_vergence;
    if (pitch >= 1e-9) {
      EXPECT_EQ(reading.object_vergence, 0.0);
      if (reading.far.status == RayStatus::ok) {
        EXPECT_EQ(reading.far.power, reading.working.power);
      }
    } else if (pitch <= map.near_pitch) {
      EXPECT_NEAR(reading.object_vergence, 2.5, 1e-12);
    }
  }
  // What the wearer has of the addition in the near gaze.
  const WornLens worn(lens, Side::right, {});
  const WornReading near = worn.read(worn.gaze_through(*lens.reference_points.near), 2.5);
  const WornReading far = worn.read(worn.gaze_through(*lens.reference_points.distance), 0.0);
  EXPECT_NEAR(lenses::mean_power(near.power) - lenses::mean_power(far.power), 2.0, 0.25);
}

}  // namespace
