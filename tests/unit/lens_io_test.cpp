// Lens and spectacles files: what is read, and what is refused by which field.
#include <gtest/gtest.h>

#include <cmath>

#include "lens_io_fixtures.hpp"

namespace {

using namespace lens_io_fixtures;

TEST(LensReader, TurnsMillimetresAndDegreesIntoSi) {
  const lenses::Lens lens = lenses::parse_lens(good_lens().dump(), "f.json");
  EXPECT_EQ(lens.index, 1.6);
  EXPECT_EQ(lens.abbe, 41.0);
  EXPECT_EQ(lens.centre_thickness, 0.002);
  EXPECT_EQ(lens.diameter, 0.065);
  EXPECT_EQ(lens.fit.vertex_distance, 0.012);
  EXPECT_EQ(lens.fit.decentration, glm::dvec2(0.001, -0.002));
  EXPECT_DOUBLE_EQ(lens.fit.pantoscopic_tilt, 8.0 * kDegree);
  EXPECT_DOUBLE_EQ(lens.fit.wrap, -5.0 * kDegree);
  EXPECT_EQ(lens.attached_to, lenses::Lens::AttachedTo::eye);
  EXPECT_EQ(lens.outline.size(), 4u);
  EXPECT_EQ(lens.reference_points.fitting_cross, glm::dvec2(0.0, 0.004));
  EXPECT_FALSE(lens.reference_points.prism);
  EXPECT_DOUBLE_EQ(std::get<lenses::Sphere>(lens.front).curvature, 1.0 / 0.088);
  const auto& torus = std::get<lenses::Torus>(lens.back);
  EXPECT_DOUBLE_EQ(torus.curvature_u, 1.0 / 0.095);
  EXPECT_DOUBLE_EQ(torus.curvature_v, -1.0 / 0.102);
  EXPECT_DOUBLE_EQ(torus.axis, 20.0 * kDegree) << "an axis is taken modulo 180";
  EXPECT_EQ(torus.revolve, lenses::Torus::Revolve::v);
}

TEST(LensReader, DefaultsFitAndTheRest) {
  const lenses::Lens lens = lenses::parse_lens(
      R"({"index": 1.5, "centre_thickness_mm": 0, "diameter_mm": 60, "front": {"type": "plane"},
          "back": {"type": "sphere", "radius_mm": null}})",
      "f.json");
  EXPECT_EQ(lens.fit.vertex_distance, 0.013);
  EXPECT_EQ(lens.fit.wrap, 0.0);
  EXPECT_EQ(lens.attached_to, lenses::Lens::AttachedTo::head);
  EXPECT_TRUE(std::holds_alternative<lenses::Plane>(lens.front));
  EXPECT_EQ(std::get<lenses::Sphere>(lens.back).curvature, 0.0) << "null is flat";
}

// The sag in metres must be the millimetre formula's, whatever the units of the coefficients.
TEST(LensReader, ScalesEvenCoefficients) {
  const lenses::Lens lens = lenses::parse_lens(lens_with_back(json::parse(kConic)).dump(), "f.json");
  const auto& conic = std::get<lenses::Conic>(lens.back);
  ASSERT_EQ(conic.even_coefficients.size(), 2u);
  const double r_mm = 20.0, r = 0.02;
  const double departure_mm = 1e-7 * std::pow(r_mm, 4) - 2e-11 * std::pow(r_mm, 6);
  const double departure = conic.even_coefficients[0] * std::pow(r, 4) + conic.even_coefficients[1] * std::pow(r, 6);
  EXPECT_NEAR(departure, departure_mm * 1e-3, 1e-14 * departure_mm) << "a few roundings";
  EXPECT_EQ(conic.conic_constant, -1.5);
  json si = json::parse(kConic);
  si.erase("even_coefficients_mm");
  si["even_coefficients"] = {100.0, -2e4};
  const lenses::Lens in_metres = lenses::parse_lens(lens_with_back(si).dump(), "f.json");
  EXPECT_EQ(std::get<lenses::Conic>(in_metres.back).even_coefficients, (std::vector{100.0, -2e4}));
}

TEST(LensReader, ReadsNetsInTheirOrder) {
  const lenses::Lens lens = lenses::parse_lens(lens_with_back(bspline()).dump(), "f.json");
  const auto& field = std::get<lenses::BsplineHeightField>(lens.back);
  EXPECT_EQ(field.count_x(), 5u);
  EXPECT_EQ(field.count_y(), 4u);
  EXPECT_DOUBLE_EQ(field.control_z.at(3 * field.count_y()), 0.3e-3) << "[3][0]";
  EXPECT_EQ(field.knots_x.front(), -0.03);

  const lenses::Lens parametric = lenses::parse_lens(lens_with_back(bspline_surface()).dump(), "f.json");
  const auto& surface = std::get<lenses::BsplineSurface>(parametric.back);
  EXPECT_EQ(surface.count_u(), 4u);
  EXPECT_EQ(surface.count_v(), 5u);
  EXPECT_EQ(surface.knots_v.front(), -0.3) << "parameters have no unit";
  EXPECT_EQ(surface.control.at(2 * 5 + 3), glm::dvec3(0.02, 0.027, 0.0015)) << "[2][3]";
}

TEST(LensReader, NamesTheFieldOfEveryLensError) {
  expect_all_refused(
      kLens, good_lens(),
      {
          {"/index", "-", "index", "is missing; must be a number from 1 to 4"},
          {"/index", "\"1.6\"", "index", "is \"1.6\"; must be a number from 1 to 4"},
          {"/index", "0.99", "index", "is 0.99; must be a number from 1 to 4"},
          {"/index", "4.5", "index", "from 1 to 4"},
          {"/index", "true", "index", "is true"},
          {"/index", "null", "index", "is null"},
          {"/abbe", "0", "abbe", "from 5 to 200"},
          {"/centre_thickness_mm", "-0.1", "centre_thickness_mm", "from 0 to 200"},
          {"/diameter_mm", "0", "diameter_mm", "a number above 0 and up to 500"},
          {"/diameter_mm", "-", "diameter_mm", "is missing"},
          {"/front", "-", "front", "is missing"},
          {"/back", "7", "back", "is 7; must be an object"},
          {"/radius", "7", "radius", "is an unknown key; allowed: index, abbe,"},
          {"/bad key\n", "7", "\"bad key\\n\"", "is an unknown key"},
          {"/fit/wrap_deg", "61", "fit.wrap_deg", "from -60 to 60"},
          {"/fit/wrap", "1", "fit.wrap",
           "allowed: vertex_distance_mm, decentration_mm, pantoscopic_tilt_deg, wrap_deg"},
          {"/fit/vertex_distance_mm", "-1", "fit.vertex_distance_mm", "from 0 to 100"},
          {"/fit/decentration_mm", "[1]", "fit.decentration_mm", "is an array of 1; must be an array of 2 numbers"},
          {"/fit/decentration_mm/1", "{}", "fit.decentration_mm[1]", "is an object; must be a number"},
          {"/fit", "[]", "fit", "must be an object"},
          {"/reference_points_mm/near", "[0]", "reference_points_mm.near", "2 numbers"},
          {"/reference_points_mm/far", "[0, 0]", "reference_points_mm.far", "fitting_cross, distance, near, prism"},
          {"/outline/polygon_mm", "[[0, 0], [1, 0]]", "outline.polygon_mm", "3 to 4096"},
          {"/outline/polygon_mm", "[[0, 0], [1, 1], [2, 2]]", "outline.polygon_mm", "encloses no area"},
          {"/outline/polygon_mm/2/0", "\"x\"", "outline.polygon_mm[2][0]", "must be a number"},
          {"/outline", "{}", "outline.polygon_mm", "is missing"},
          {"/attached_to", "\"nose\"", "attached_to", "is \"nose\"; must be one of \"head\" \"eye\""},
          {"/version", "2", "version", "is 2, newer than this program reads; version 1 is allowed"},
          {"/version", "\"1\"", "version", "must be the number 1"},
          {"/version", "0", "version", "must be the number 1"},
          {"/prescription", "{\"sphere\": 1}", "front", "is given beside prescription"},
          {"/design", "\"bifocal\"", "design", "is given without a prescription"},
          {"/material", "\"CR-39\"", "material", "is given without a prescription"},
          {"/order", "{}", "order.ordered", "is missing; must be a prescription"},
          {"/order", "{\"ordered\": {\"cylinder\": 1}}", "order.ordered.sphere", "is missing; must be a number"},
      });
}

TEST(LensReader, NamesTheFieldOfEverySurfaceError) {
  expect_all_refused(
      kLens, good_lens(),
      {
          {"/front/type", "-", "front.type", "is missing"},
          {"/front/type", "\"Sphere\"", "front.type", "one of \"plane\" \"sphere\" \"conic\" \"torus\""},
          {"/front/type", "\"file\"", "front.radius_mm", "allowed: type, path, rows, side, surface, smoothing_um"},
          {"/front/type", "\"segment\"", "front.radius_mm", "allowed: type, base, segment, boundary_mm"},
          {"/front/type", "\"plane\"", "front.radius_mm",
           "is an unknown key; allowed: type, decentration_mm, slope, height_mm"},
          {"/front/slope", "[3, 0]", "front.slope[0]", "is 3; must be a number from -2 to 2"},
          {"/front/slope", "0.1", "front.slope", "must be an array of 2 numbers"},
          {"/front/height_mm", "101", "front.height_mm", "from -100 to 100"},
          {"/back/decentration_mm", "[0, -101]", "back.decentration_mm[1]", "from -100 to 100"},
          {"/front/type", "3", "front.type", "is 3"},
          {"/front/radius_mm", "0", "front.radius_mm", "at least 0.001 in magnitude"},
          {"/front/radius_mm", "\"flat\"", "front.radius_mm", "null for flat"},
          {"/front/radius_mm", "-", "front.radius_mm", "is missing"},
          {"/back/radius_u_mm", "-1e-9", "back.radius_u_mm", "at least 0.001"},
          {"/back/axis_deg", "\"N\"", "back.axis_deg", "a number of degrees"},
          {"/back/revolve", "\"x\"", "back.revolve", "one of \"u\" \"v\""},
          {"/back/radius_mm", "3", "back.radius_mm", "allowed: type, radius_u_mm, radius_v_mm, axis_deg, revolve"},
      });
  expect_all_refused(kLens, lens_with_back(json::parse(kConic)),
                     {
                         {"/back/conic_constant", "1e5", "back.conic_constant", "from -10000 to 10000"},
                         {"/back/even_coefficients_mm", "3", "back.even_coefficients_mm", "an array of 0 to 8 numbers"},
                         {"/back/even_coefficients", "[1]", "back.even_coefficients_mm", "only one of the two"},
                         {"/back/even_coefficients_mm/1", "2", "back.even_coefficients_mm[1]", "from -1 to 1"},
                     });
}

TEST(LensReader, NamesTheFieldOfEverySegmentError) {
  expect_all_refused(
      kLens, lens_with_back(segment_surface()),
      {
          {"/back/base", "-", "back.base", "is missing; must be a surface"},
          {"/back/segment", "-", "back.segment", "is missing; must be a surface"},
          {"/back/boundary_mm", "-", "back.boundary_mm", "is missing"},
          {"/back/base", "3", "back.base", "is 3; must be an object"},
          {"/back/base/radius_mm", "0", "back.base.radius_mm", "at least 0.001"},
          {"/back/base/slope", "[0, 0]", "back.base.slope", "is not allowed on a base"},
          {"/back/base", R"({"type": "file"})", "back.base.path", "is missing"},
          {"/back/segment/type", "\"segment\"", "back.segment.type",
           "is \"segment\"; must be one of \"plane\" \"sphere\" \"conic\" \"torus\" \"bspline\" \"bspline_surface\""},
          {"/back/segment/radius", "1", "back.segment.radius", "is an unknown key"},
          {"/back/segment/slope/1", "null", "back.segment.slope[1]", "is null"},
          {"/back/boundary_mm", "[[0, 0], [1, 0]]", "back.boundary_mm", "3 to 512"},
          {"/back/boundary_mm", "[[0, 0], [1, 1], [3, 3]]", "back.boundary_mm", "encloses no area"},
          {"/back/boundary_mm/4/1", "501", "back.boundary_mm[4][1]", "from -500 to 500"},
      });
  json long_boundary = segment_surface();
  for (int i = 0; i < 513; ++i) long_boundary["boundary_mm"][static_cast<std::size_t>(i)] = {i, i % 7};
  expect_refused(kLens, lens_with_back(long_boundary).dump(), "back.boundary_mm", "3 to 512");
}

TEST(LensReader, ReadsWhereSurfacesStand) {
  const lenses::Lens lens = lenses::parse_lens(lens_with_back(segment_surface()).dump(), "f.json");
  EXPECT_EQ(lens.front_placement, lenses::Placement{}) << "in the lens's own axes unless told";
  EXPECT_EQ(lens.back_placement, (lenses::Placement{{0.001, 0.0}, {0.03, 0.04}, -0.0001}));
  const auto& surface = std::get<lenses::SegmentedSurface>(lens.back);
  EXPECT_DOUBLE_EQ(std::get<lenses::Sphere>(surface.base).curvature, 1.0 / 0.088);
  EXPECT_DOUBLE_EQ(std::get<lenses::Torus>(surface.segment).curvature_v, 1.0 / 0.061);
  EXPECT_EQ(surface.segment_placement, (lenses::Placement{{0.0025, -0.008}, {0.01, -0.02}, 0.00005}));
  ASSERT_EQ(surface.boundary.size(), 5u);
  EXPECT_EQ(surface.boundary[3], glm::dvec2(0.0025, -0.01725));
}

TEST(LensReader, NamesTheFieldOfEverySplineError) {
  expect_all_refused(
      kLens, lens_with_back(bspline()),
      {
          {"/back/knots_x_mm", "[0, 1, 2, 3, 4, 5, 6]", "back.knots_x_mm", "an array of 8 to 104 numbers"},
          {"/back/knots_x_mm/4", "31", "back.knots_x_mm[5]", "must not decrease"},
          {"/back/knots_x_mm/4", "-30", "back.knots_x_mm[4]", "may be given 4 times"},
          {"/back/knots_x_mm/4", "-29.99999999999", "back.knots_x_mm[4]", "equal or apart"},
          {"/back/knots_y_mm", "[0, 1, 2, 3, 3, 4, 5, 6]", "back.knots_y_mm", "no valid domain"},
          {"/back/knots_y_mm/2", "null", "back.knots_y_mm[2]", "is null"},
          {"/back/knots_y_mm", "[0, 1, 2, 3, 4, 5, 6, 7, 8]", "back.control_z_mm[0]", "a row of 5"},
          {"/back/control_z_mm/2", "[0, 0, 0]", "back.control_z_mm[2]", "is an array of 3; must be a row of 4"},
          {"/back/control_z_mm/2", "0", "back.control_z_mm[2]", "must be a row of 4"},
          {"/back/control_z_mm/4", "-", "back.control_z_mm", "is an array of 4; must be an array of 5 rows of 4"},
          {"/back/control_z_mm/3/1", "\"7\"", "back.control_z_mm[3][1]", "must be a number from -1000 to 1000"},
          {"/back/control_z_mm", "-", "back.control_z_mm", "is missing"},
      });
  expect_all_refused(kLens, lens_with_back(bspline_surface()),
                     {
                         {"/back/control_mm/1/2", "[0, 0]", "back.control_mm[1][2]", "3 numbers"},
                         {"/back/control_mm/1/2/2", "1e9", "back.control_mm[1][2][2]", "is 1e+09"},
                         {"/back/control_mm/3", "[]", "back.control_mm[3]", "a row of 5"},
                     });
  json mirrored = bspline_surface();
  for (json& row : mirrored["control_mm"]) {
    for (json& point : row) point[0] = -point[0].get<double>();
  }
  expect_refused(kLens, lens_with_back(mirrored).dump(), "back.control_mm", "is mirrored");
}

TEST(SpectaclesReader, ReadsBothLensesAndTheTint) {
  const lenses::Spectacles pair = lenses::parse_spectacles(good_spectacles().dump(), "f.json");
  EXPECT_EQ(pair.name, "a pair");
  EXPECT_TRUE(std::holds_alternative<lenses::Torus>(pair.lens[static_cast<int>(lenses::Side::right)].back));
  EXPECT_TRUE(std::holds_alternative<lenses::Conic>(pair.lens[static_cast<int>(lenses::Side::left)].front));
  EXPECT_EQ(pair.tint_transmission, glm::dvec3(0.9, 0.8, 0.7));
}

TEST(SpectaclesReader, NamesTheFieldOfEveryError) {
  expect_all_refused(kSpectacles, good_spectacles(),
                     {
                         {"/right", "-", "right", "is missing; must be a lens"},
                         {"/left", "-", "left", "is missing"},
                         {"/left", "null", "left", "is null; must be an object"},
                         {"/right/front/radius_mm", "0", "right.front.radius_mm", "at least 0.001"},
                         {"/left/back/control_z_mm/3/2", "[]", "left.back.control_z_mm[3][2]", "is an array of 0"},
                         {"/tint/transmission/1", "1.5", "tint.transmission[1]", "from 0 to 1"},
                         {"/tint/transmission", "-", "tint.transmission", "is missing"},
                         {"/tint/colour", "1", "tint.colour", "allowed: transmission"},
                         {"/name", "3", "name", "must be a string"},
                         {"/middle", "3", "middle", "allowed: name, right, left, tint"},
                         {"/right/version", "3", "right.version", "is 3"},
                     });
}

}  // namespace
