// The pupil's diameter and the amplitude of accommodation against the published values.
#include "lenses/pupil.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "lenses/trace.hpp"

namespace {

const double kField = std::numbers::pi * 30.0 * 30.0;  // square degrees of a circle 60 degrees across

TEST(PupilInLight, AgreesWithWatsonAndYellott) {
  // The two decimals of the published unified formula.
  EXPECT_NEAR(1e3 * lenses::pupil_diameter_in_light(100.0, kField, true, 30.0), 2.89, 0.005);
  EXPECT_NEAR(1e3 * lenses::pupil_diameter_in_light(100.0, kField, true, 60.0), 2.70, 0.005);
}

TEST(PupilInLight, OneEyeCountsATenth) {
  EXPECT_DOUBLE_EQ(lenses::pupil_diameter_in_light(100.0, kField, false, 40.0),
                   lenses::pupil_diameter_in_light(10.0, kField, true, 40.0));
}

TEST(PupilInLight, NarrowsWithLightAndStaysWithinAnEye) {
  for (const double age : {20.0, 45.0, 83.0}) {
    double last = 0.0081;
    for (double luminance = 1e-4; luminance < 1e5; luminance *= 10.0) {
      const double d = lenses::pupil_diameter_in_light(luminance, kField, true, age);
      EXPECT_LT(d, last);
      EXPECT_GT(d, 0.0018);
      last = d;
    }
  }
  // Darkness at the formula's reference age.
  EXPECT_NEAR(lenses::pupil_diameter_in_light(0.0, kField, true, 28.58), 7.75e-3, 1e-12);
}

TEST(AccommodationAmplitude, FallsWithAgeAsMeasured) {
  // Anderson et al. 2008: half a dioptre is left at 52.
  EXPECT_NEAR(lenses::accommodation_amplitude_at(52.0), 0.5, 0.05);
  EXPECT_LT(lenses::accommodation_amplitude_at(10.0), 7.083);
  EXPECT_GT(lenses::accommodation_amplitude_at(10.0), 7.0);
  EXPECT_LT(lenses::accommodation_amplitude_at(70.0), 0.05);
}

}  // namespace
