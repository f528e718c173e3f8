// Lens files that hold a prescription in place of surfaces, and the order that finished lenses carry.
#include <gtest/gtest.h>

#include <cmath>

#include "lens_io_fixtures.hpp"
#include "lenses/design/lens_shape.hpp"
#include "lenses/lens_io/trace_io.hpp"

namespace {

using namespace lens_io_fixtures;
namespace design = lenses::design;

json good_order() {
  return json::parse(R"({"version": 1, "name": "an order", "prescription": {"sphere": -2.25, "cylinder": -0.75,
    "axis": 175, "prism": [{"magnitude": 0.5, "base": 180}]}, "design": "single_vision", "material": "MR-8"})");
}

design::PointPower reading(const lenses::Lens& lens) {
  const auto read = design::reading_at_back(design::LensShape(lens), {0.0, 0.0});
  EXPECT_TRUE(read);
  return read.value_or(design::PointPower{});
}

TEST(PrescriptionReader, MakesTheLens) {
  const lenses::Lens lens = lenses::parse_lens(good_order().dump(), "f.json");
  EXPECT_EQ(lens.index, 1.6);
  EXPECT_EQ(lens.abbe, 41.0);
  EXPECT_EQ(lens.diameter, 0.065);
  EXPECT_EQ(lens.fit.vertex_distance, 0.013);
  EXPECT_DOUBLE_EQ(lens.fit.pantoscopic_tilt, 8.0 * kDegree);
  EXPECT_DOUBLE_EQ(lens.fit.wrap, 5.0 * kDegree);
  ASSERT_TRUE(lens.order);
  EXPECT_EQ(lens.order->ordered.cylinder, -0.75);
  EXPECT_DOUBLE_EQ(lens.order->ordered.axis, 175.0 * kDegree);
  const design::PointPower power = reading(lens);
  // Base 180 is at the examiner's left, the wearer's right.
  EXPECT_NEAR(power.prism.x, 0.5, 1e-6);
  EXPECT_NEAR(power.prism.y, 0.0, 1e-6);
  // The axis 175 is the wearer's 5.
  EXPECT_NEAR(power.power[0][0], -2.25 - 0.75 * std::pow(std::sin(5.0 * kDegree), 2), 1e-6);
}

TEST(PrescriptionReader, WhatIsMadeIsWrittenAndReadAsALens) {
  const std::string text = lenses::to_json(lenses::parse_lens(good_order().dump(), "f.json"));
  EXPECT_EQ(lenses::to_json(lenses::parse_lens(text, "f.json")), text);
  EXPECT_EQ(json::parse(text).at("order"), json::parse(R"({"ordered": {"sphere": -2.25, "cylinder": -0.75,
    "axis": 175, "prism": [{"magnitude": 0.5, "base": 180}]}})"));
}

TEST(PrescriptionReader, ReadsOrdersOfFinishedLenses) {
  json lens = good_lens();
  lens["order"] = json::parse(R"({"ordered": {"sphere": 1, "cylinder": 2, "axis": 0, "add": 2.5},
    "compensated": {"sphere": 62.5, "cylinder": 0, "prism": [{"magnitude": 40, "base": "up"}]}})");
  const lenses::Lens read = lenses::parse_lens(lens.dump(), "f.json");
  ASSERT_TRUE(read.order && read.order->compensated);
  EXPECT_DOUBLE_EQ(read.order->ordered.axis, 180.0 * kDegree) << "as ISO 8429 writes 0";
  EXPECT_EQ(read.order->ordered.addition, 2.5);
  EXPECT_EQ(read.order->compensated->sphere, 62.5) << "as a strong contact lens has it";
  EXPECT_DOUBLE_EQ(read.order->compensated->prism.at(0).base, 90.0 * kDegree);
  EXPECT_EQ(lenses::parse_lens(lenses::to_json(read), "f.json"), read);
}

// Only the pair knows where the nose is.
TEST(PrescriptionReader, InAndOutFollowTheSide) {
  json order = good_order();
  order["prescription"]["prism"][0]["base"] = "in";
  const json pair{{"right", order}, {"left", order}};
  const lenses::Spectacles spectacles = lenses::parse_spectacles(pair.dump(), "f.json");
  EXPECT_NEAR(reading(spectacles.lens[0]).prism.x, -0.5, 1e-6);
  EXPECT_NEAR(reading(spectacles.lens[1]).prism.x, 0.5, 1e-6);
  expect_refused(kLens, order.dump(), "prescription.prism[0].base", "\"side\" must say it");
  order["side"] = "left";
  EXPECT_NEAR(reading(lenses::parse_lens(order.dump(), "f.json")).prism.x, 0.5, 1e-6);
  expect_refused(kSpectacles, json{{"right", order}, {"left", order}}.dump(), "right.side", "must be \"right\" here");
}

TEST(PrescriptionReader, TraceRequestsMayHoldPrescriptions) {
  const json line{{"lens", good_order()}, {"side", "left"}, {"direction", {0, 0, -1}}};
  const lenses::TraceRequest request = lenses::parse_trace_line(line.dump(), "f.jsonl", 1, ".");
  ASSERT_TRUE(request.lens && request.lens->order);
  EXPECT_NEAR(reading(*request.lens).prism.x, 0.5, 1e-6);
}

TEST(PrescriptionReader, DesignFollowsTheAddition) {
  const auto made = [](const char* text) { return lenses::parse_lens(text, "f.json"); };
  EXPECT_TRUE(
      std::holds_alternative<lenses::BsplineHeightField>(made(R"({"prescription": {"sphere": 1, "add": 2}})").back));
  EXPECT_TRUE(std::holds_alternative<lenses::Sphere>(made(R"({"prescription": {"sphere": 1}})").back));
  const lenses::Lens bifocal =
      made(R"({"prescription": {"sphere": 1, "add": 2}, "design": "bifocal", "segment": "executive", "side": "left"})");
  EXPECT_TRUE(std::holds_alternative<lenses::SegmentedSurface>(bifocal.front));
  EXPECT_GT(bifocal.reference_points.near->x, 0.0);
  const lenses::Lens contact = made(R"({"prescription": {"sphere": -3}, "design": "contact", "contact": "rigid"})");
  EXPECT_EQ(contact.attached_to, lenses::Lens::AttachedTo::eye);
  EXPECT_DOUBLE_EQ(std::get<lenses::Sphere>(contact.back).curvature, 1.0 / 0.0078);
}

TEST(PrescriptionReader, NamesTheFieldOfEveryError) {
  expect_all_refused(
      kLens, good_order(),
      {
          {"/prescription", "-", "design", "is given without a prescription"},
          {"/prescription", "[]", "prescription", "must be an object"},
          {"/prescription/sphere", "-", "prescription.sphere", "is missing"},
          {"/prescription/sphere", "41", "prescription.sphere", "is 41; must be a number from -40 to 40"},
          {"/prescription/sphere", "\"plano\"", "prescription.sphere", "must be a number"},
          {"/prescription/cylinder", "21", "prescription.cylinder", "from -20 to 20"},
          {"/prescription/axis", "-", "prescription.axis", "is missing; must be a number of degrees"},
          {"/prescription/axis", "\"x\"", "prescription.axis", "a number of degrees"},
          {"/prescription/add", "-1", "prescription.add", "from 0 to 6"},
          {"/prescription/add", "1", "prescription.add", "must be 0, or the design bifocal or progressive"},
          {"/prescription/vertex", "1", "prescription.vertex", "allowed: sphere, cylinder, axis, add, prism"},
          {"/prescription/prism", "{}", "prescription.prism", "an array of 0 to 8 prisms"},
          {"/prescription/prism/0/magnitude", "31", "prescription.prism[0].magnitude", "from 0 to 30"},
          {"/prescription/prism/0/base", "361", "prescription.prism[0].base", "from 0 to 360"},
          {"/prescription/prism/0/base", "\"left\"", "prescription.prism[0].base", "\"up\" \"down\" \"in\" \"out\""},
          {"/prescription/prism/0/base", "-", "prescription.prism[0].base", "is missing"},
          {"/design", "\"varifocal\"", "design", "one of \"single_vision\" \"bifocal\" \"progressive\" \"contact\""},
          {"/design", "\"bifocal\"", "prescription.add", "from 0.25 to 6"},
          {"/material", "\"glass\"", "material", "\"MR-174\""},
          {"/index", "1.6", "index", "is given beside material"},
          {"/abbe", "4", "abbe", "from 5 to 200"},
          {"/front", "{\"type\": \"plane\"}", "front", "is given beside prescription"},
          {"/back", "7", "back", "is given beside prescription"},
          {"/attached_to", "\"eye\"", "attached_to", "is given beside prescription"},
          {"/reference_points_mm", "{}", "reference_points_mm", "is given beside prescription"},
          {"/order", "{}", "order", "is given beside prescription"},
          {"/side", "\"nose\"", "side", "one of \"right\" \"left\""},
          {"/as_worn", "1", "as_worn", "is 1; must be true or false"},
          {"/prism_thinning", "true", "prism_thinning", "is for progressive lenses only"},
          {"/front_design", "\"flat\"", "front_design", "one of \"spherical\" \"aspheric\""},
          {"/toric", "1", "toric", "one of \"tyre\" \"barrel\""},
          {"/segment", "\"ft35\"", "segment", "one of \"ft28\" \"r24\" \"executive\""},
          {"/segment_top_mm", "0", "segment_top_mm", "from -15 to -0.5"},
          {"/base_curve_D", "31", "base_curve_D", "from 0 to 30"},
          {"/back_radius_mm", "8", "back_radius_mm", "is for contact lenses only"},
          {"/centre_thickness_mm", "0.5", "centre_thickness_mm", "at least 1.2 mm is needed"},
          {"/diameter_mm", "-3", "diameter_mm", "from 1 to 150"},
          {"/outline/polygon_mm", "[[90, 0], [0, 90], [-90, 0]]", "outline", "across"},
          {"/fit/wrap_deg", "61", "fit.wrap_deg", "from -60 to 60"},
          {"/refraction_vertex_mm", "31", "refraction_vertex_mm", "from 0 to 30"},
          {"/version", "2", "version", "newer than this program reads"},
      });
}

// The committed examples of the command are what they say.
TEST(PrescriptionExamples, AreReadAsOrderedOrAsCompensated) {
  for (const char* name : {"single_vision_minus225_right", "bifocal_ft28_plus400_right", "as_worn_minus600_right",
                           "contact_soft_minus500"}) {
    SCOPED_TRACE(name);
    const lenses::Lens lens = lenses::read_lens(std::string(VERGENCE_ASSETS) + "/lenses/" + name + ".json");
    ASSERT_TRUE(lens.order);
    const lenses::Prescription& expected = lens.order->compensated.value_or(lens.order->ordered);
    const design::PointPower read = reading(lens);
    const design::PointPower wanted = design::ordered_power(expected);
    for (int i = 0; i < 2; ++i) {
      EXPECT_NEAR(read.power[i][0], wanted.power[i][0], 1e-6);
      EXPECT_NEAR(read.power[i][1], wanted.power[i][1], 1e-6);
      EXPECT_NEAR(read.prism[i], wanted.prism[i], 1e-6);
    }
  }
  const lenses::Spectacles pair =
      lenses::read_spectacles(std::string(VERGENCE_ASSETS) + "/spectacles/ordered_progressive.json");
  EXPECT_TRUE(pair.lens[0].order && pair.lens[0].order->compensated) << "thinned";
}

// Whatever a file asks for, it is made or refused, never both half.
TEST(PrescriptionReader, RefusesWhatNoLensCanBe) {
  const auto refused = [](const char* text, const std::string& field, const std::string& reason) {
    SCOPED_TRACE(text);
    expect_refused(kLens, text, field, reason);
  };
  refused(R"({"prescription": {"sphere": -40, "cylinder": -20, "axis": 1}})", "prescription.sphere", "-60");
  refused(R"({"prescription": {"sphere": -40}, "index": 1.3})", "prescription", "wide; at least 15 mm is needed");
  refused(R"({"prescription": {"sphere": 38}, "design": "contact", "refraction_vertex_mm": 30})", "prescription.sphere",
          "before the eye");
  refused(R"({"prescription": {"sphere": 0, "prism": [{"magnitude": 5, "base": 0}]}, "prism_by": "decentration"})",
          "prism_by", "tilt always is");
  refused(R"({"prescription": {"sphere": 25, "add": 3.5}, "design": "progressive"})", "prescription", "cannot be met");
  refused(R"({"prescription": {"sphere": 12}, "diameter_mm": 90})", "diameter_mm", "at most 49.8 mm is possible");
  refused(R"({"prescription": {"sphere": 20}, "minimum_edge_thickness_mm": 20, "outline": {"polygon_mm":
    [[0.001, 0], [0, 0.001], [-0.001, 0]]}, "centre_thickness_mm": 0.01})",
          "centre_thickness_mm", "at least");
}

}  // namespace
