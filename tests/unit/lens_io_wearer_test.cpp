// Wearer and headset files: what is read, and what is refused by which field.
#include <gtest/gtest.h>

#include "lens_io_fixtures.hpp"

namespace {

using namespace lens_io_fixtures;

TEST(WearerReader, ReadsEyesAndViewers) {
  const lenses::Wearer wearer = lenses::parse_wearer(good_wearer().dump(), "f.json");
  EXPECT_EQ(wearer.age, 52.0);
  EXPECT_EQ(wearer.pupillary_distance[1], 0.0325);
  const lenses::Eye& right = wearer.eye[0];
  EXPECT_EQ(right.axial_length, 0.024);
  EXPECT_EQ(right.pupil_diameter, 0.003);
  EXPECT_EQ(right.accommodation_amplitude, 1.5);
  const auto& refraction = std::get<lenses::Refraction>(right.power);
  EXPECT_EQ(refraction.sphere, -2.0);
  EXPECT_DOUBLE_EQ(refraction.axis, 10.0 * kDegree);
  ASSERT_TRUE(right.zernike);
  EXPECT_DOUBLE_EQ(right.zernike->coefficients.at(4), -0.2e-6);
  const auto& relaxed = std::get<lenses::RelaxedPower>(wearer.eye[1].power);
  EXPECT_EQ(relaxed.q2, 40.5);
  EXPECT_DOUBLE_EQ(relaxed.axis, 30.0 * kDegree);
  ASSERT_TRUE(wearer.viewer[0]);
  EXPECT_EQ(wearer.viewer[0]->worn_in_headset, lenses::Viewer::Worn::contacts);
  EXPECT_FALSE(wearer.viewer[1]);
}

TEST(WearerReader, DefaultsAndLeavesAbsentWhatFollowsAgeOrLight) {
  const lenses::Wearer wearer = lenses::parse_wearer("{}", "f.json");
  EXPECT_EQ(wearer.age, 35.0);
  EXPECT_EQ(wearer.pupillary_distance[0], 0.0315);
  EXPECT_EQ(wearer.eye[0].axial_length, 0.025);
  EXPECT_FALSE(wearer.eye[0].pupil_diameter);
  EXPECT_FALSE(wearer.eye[1].accommodation_amplitude);
  EXPECT_TRUE(std::holds_alternative<std::monostate>(wearer.eye[1].power));
}

TEST(WearerReader, NamesTheFieldOfEveryError) {
  expect_all_refused(
      kWearer, good_wearer(),
      {
          {"/age", "0", "age", "from 1 to 120"},
          {"/age", "121", "age", "from 1 to 120"},
          {"/pupillary_distance_mm/0", "14", "pupillary_distance_mm[0]", "from 15 to 45"},
          {"/pupillary_distance_mm", "63", "pupillary_distance_mm", "an array of 2 numbers"},
          {"/right/axial_length_mm", "14", "right.axial_length_mm", "from 15 to 40"},
          {"/right/pupil_diameter_mm", "0.4", "right.pupil_diameter_mm", "from 0.5 to 9"},
          {"/right/pupil_diameter_mm", "null", "right.pupil_diameter_mm", "is null"},
          {"/right/accommodation_amplitude_D", "-1", "right.accommodation_amplitude_D", "from 0 to 25"},
          {"/right/refraction/sphere", "41", "right.refraction.sphere", "from -40 to 40"},
          {"/right/refraction/sphere", "-", "right.refraction.sphere", "is missing"},
          {"/right/refraction/cylinder", "-21", "right.refraction.cylinder", "from -20 to 20"},
          {"/right/refraction/axis", "-", "right.refraction.axis", "as the cylinder is not 0"},
          {"/right/refraction/add", "2", "right.refraction.add", "allowed: sphere, cylinder, axis"},
          {"/right/relaxed_power_D", "[40, 40]", "right.relaxed_power_D", "beside refraction"},
          {"/right/power_axis_deg", "3", "right.power_axis_deg", "without relaxed_power_D"},
          {"/right/refraction_vertex_mm", "31", "right.refraction_vertex_mm", "from 0 to 30"},
          {"/right/entrance_pupil_depth_mm", "-1", "right.entrance_pupil_depth_mm", "from 0 to 10"},
          {"/right/centre_of_rotation_depth_mm", "99", "right.centre_of_rotation_depth_mm", "from 0 to 30"},
          {"/right/zernike_um/coefficients", "[]", "right.zernike_um.coefficients", "1 to 66"},
          {"/right/zernike_um/coefficients/2", "1e4", "right.zernike_um.coefficients[2]", "from -1000 to 1000"},
          {"/right/zernike_um/pupil_diameter_mm", "-", "right.zernike_um.pupil_diameter_mm", "is missing"},
          {"/left/power_axis_deg", "-", "left.power_axis_deg", "as the two powers differ"},
          {"/left/relaxed_power_D/1", "-1", "left.relaxed_power_D[1]", "from 0 to 200"},
          {"/left/pupil", "3", "left.pupil", "is an unknown key; allowed: axial_length_mm"},
          {"/viewer/right/worn_in_headset", "\"hat\"", "viewer.right.worn_in_headset", "\"nothing\" \"contacts\""},
          {"/viewer/both", "{}", "viewer.both", "allowed: right, left"},
          {"/pd", "63", "pd", "allowed: name, age, pupillary_distance_mm, right, left, viewer"},
      });
  // F / (1 - dF): a lens of 40 D focuses 25 mm behind itself, before a pupil at 33 mm.
  expect_refused(kWearer, R"({"right": {"refraction": {"sphere": 40}, "refraction_vertex_mm": 30}})",
                 "right.refraction", "focus at or before the pupil, 33.05 mm");
}

TEST(HeadsetReader, ReadsDefaultsAndNamesErrors) {
  const lenses::HeadsetDisplay headset = lenses::parse_headset(good_headset().dump(), "f.json");
  EXPECT_EQ(headset.focal_distance, 1.3);
  EXPECT_EQ(headset.pixels_per_degree, 51.0);
  EXPECT_EQ(headset.luminance, 150.0);
  EXPECT_EQ(headset.view_origin, lenses::HeadsetDisplay::ViewOrigin::rotation_centre);
  EXPECT_EQ(lenses::parse_headset("{}", "f.json").pixels_per_degree, 22.0);
  expect_all_refused(kHeadset, good_headset(),
                     {
                         {"/focal_distance_m", "0", "focal_distance_m", "from 0.1 to"},
                         {"/pixels_per_degree", "0", "pixels_per_degree", "from 1 to 1000"},
                         {"/luminance_cd_m2", "\"bright\"", "luminance_cd_m2", "must be a number"},
                         {"/view_origin", "\"eye\"", "view_origin", "\"pupil\" \"rotation_centre\""},
                         {"/fov", "90", "fov", "allowed: focal_distance_m"},
                     });
  EXPECT_NO_THROW((void)lenses::read_headset(std::string(VERGENCE_ASSETS) + "/headsets/example.json"));
}

}  // namespace
