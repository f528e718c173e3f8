// Each option of `vergence render` does what its help says: every check would fail if the option were without effect or
// its sign turned round.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>

#include "render/image/exr.hpp"
#include "render/image/png.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/tiny_scene.hpp"

namespace {

using nlohmann::json;
using render::FloatImage;
using render::Image8;
using support::Patch;
using Words = std::vector<std::string>;

constexpr int kSize = 64;
constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kHalfPd = 0.0315;          // m, the default wearer's
constexpr double kPupilToCentre = 0.01045;  // m, from the entrance pupil back to the centre of rotation
constexpr double kPixel = 0.4;              // what a centroid of some pixels without partial cover may be off by, px
const std::string kMyope = R"({"age": 70, "right": {"refraction": {"sphere": -2.5}}, "left": {}})";
const std::string kMinusLens = VERGENCE_ASSETS "/spectacles/myopia.json";  // -6 D, no prism

struct Drawn {
  FloatImage image;
  json report;
};

Words operator+(Words a, const Words& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

double pixels_per_tangent(double fov_deg) {
  return 0.5 * kSize / std::tan(0.5 * fov_deg * kDegree);
}

const std::vector<float>& plane(const FloatImage& image, const std::string& channel) {
  const auto place = std::ranges::find(image.channels, channel);
  return image.planes.at(static_cast<std::size_t>(place - image.channels.begin()));
}

float at_centre(const FloatImage& image, const std::string& channel) {
  return plane(image, channel)[static_cast<std::size_t>(image.height / 2 * image.width + image.width / 2)];
}

// Of the light in one eye's picture, in pixels right of and above its middle; NaN where it is black.
glm::dvec2 centroid(const FloatImage& image, int first_column = 0, int width = 0) {
  width = width == 0 ? image.width : width;
  double sum = 0.0;
  glm::dvec2 moment(0.0);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double light = plane(image, "G")[static_cast<std::size_t>(y * image.width + first_column + x)];
      sum += light;
      moment += light * glm::dvec2(x + 0.5 - 0.5 * width, 0.5 * image.height - y - 0.5);
    }
  }
  return moment / sum;
}

void expect_at(const FloatImage& image, double right, double up) {
  const glm::dvec2 place = centroid(image);
  EXPECT_NEAR(place.x, right, kPixel);
  EXPECT_NEAR(place.y, up, kPixel);
}

// A bright square around `centre`, facing +z.
Patch square(const glm::dvec3& centre, double half) {
  const auto h = static_cast<float>(half);
  return {glm::vec3(centre) - glm::vec3(h, h, 0), {2 * h, 0, 0}, {0, 2 * h, 0}, 1.0F};
}

// So far away that it does not matter where the pupil is.
Patch far_square(double yaw_deg, double pitch_deg, double half = 50.0) {
  const double yaw = yaw_deg * kDegree;
  const double pitch = pitch_deg * kDegree;
  const glm::dvec3 direction(std::sin(yaw) * std::cos(pitch), std::sin(pitch), -std::cos(yaw) * std::cos(pitch));
  return square(1000.0 * direction, half);
}

class RenderOption : public testing::Test {
 protected:
  void scene(const std::vector<Patch>& patches, const std::vector<support::NamedPoint>& targets = {}) {
    scene_ = file("scene.gltf", support::patch_gltf(patches, targets).text());
  }
  std::string file(const std::string& name, const std::string& text) { return folder_.write(name, text); }

  // Runs render with what is not said: the right eye, small, a pinhole.
  json run(const std::string& output, Words words) {
    const Words usual{"--eye", "right", "--size", "64x64", "--mode", "pinhole"};
    for (std::size_t i = 0; i < usual.size(); i += 2) {
      if (std::ranges::find(words, usual[i]) == words.end()) {
        words = words + Words{usual[i], usual[i + 1]};
      }
    }
    const auto result =
        support::run_program({.arguments = Words{"render", "--scene", scene_, "--json", "--output", output} + words});
    EXPECT_EQ(result.exit_status, 0) << result.err;
    return json::parse(result.out);
  }
  Drawn draw(const Words& words) {
    const std::string output = (folder_.path() / "out.exr").string();
    const json report = run(output, words);
    return {render::read_exr(output), report};
  }
  Image8 draw_png(const Words& words) {
    const std::string output = (folder_.path() / "out.png").string();
    run(output, words);
    return render::read_png(output);
  }
  // Display values r, g, b.
  std::vector<int> middle(const Words& words) {
    const Image8 image = draw_png(words);
    const auto at = image.rgb.begin() + 3 * (kSize / 2 * kSize + kSize / 2);
    return {at, at + 3};
  }
  json sight(const Words& words) { return draw(words).report.at("sight").at(0); }

  support::TemporaryFolder folder_;
  std::string scene_;
};

TEST_F(RenderOption, GazeTurnsThePictureRightAndUp) {
  scene({far_square(10, 0)});
  const double step = pixels_per_tangent(60) * std::tan(10 * kDegree);
  expect_at(draw({}).image, step, 0);
  expect_at(draw({"--gaze", "10,0"}).image, 0, 0);
  expect_at(draw({"--gaze", "20,0"}).image, -step, 0);
  scene({far_square(0, 10)});
  expect_at(draw({"--gaze", "0,20"}).image, 0, -step);
  const json gaze = sight({"--gaze", "12,-7"}).at("gaze_deg");
  EXPECT_NEAR(gaze.at(0), 12, 1e-3);
  EXPECT_NEAR(gaze.at(1), -7, 1e-3);
}

TEST_F(RenderOption, PoseTurnsAndMovesTheHead) {
  scene({far_square(10, 10)});
  expect_at(draw({"--pose", "0,0,0,10,10"}).image, 0, 0);
  expect_at(draw({"--pose", "0,0,0,10,0"}).image, 0, pixels_per_tangent(60) * std::tan(10 * kDegree));
  scene({square({0.5, 1.0, -3.0}, 0.1)});
  const glm::dvec2 place = pixels_per_tangent(60) / 2 * glm::dvec2(0.5 - 0.1 - kHalfPd, 1.0 - 0.7);
  expect_at(draw({"--pose", "0.1,0.7,-1,0,0"}).image, place.x, place.y);
}

TEST_F(RenderOption, PoseTakesACamera) {
  auto gltf = support::patch_gltf({far_square(10, 0)});
  const double half = 5.0 * kDegree;  // turned 10 degrees to the right
  gltf.root["nodes"].push_back(
      {{"name", "aside"}, {"camera", 0}, {"rotation", {0, -std::sin(half), 0, std::cos(half)}}});
  gltf.root["scenes"][0]["nodes"].push_back(gltf.root["nodes"].size() - 1);
  scene_ = file("scene.gltf", gltf.text());
  const double step = pixels_per_tangent(60) * std::tan(10 * kDegree);
  expect_at(draw({}).image, step, 0);
  expect_at(draw({"--pose", "origin"}).image, step, 0);
  expect_at(draw({"--pose", "aside"}).image, 0, 0);
  expect_at(draw({"--pose", "1"}).image, 0, 0);
}

TEST_F(RenderOption, WithoutACameraTheWholeSceneIsSeen) {
  auto gltf = support::patch_gltf({square({300.0, -200.0, 50.0}, 20.0)});
  gltf.root.erase("cameras");
  gltf.root["nodes"].erase(1);
  gltf.root["scenes"][0]["nodes"] = {0};
  scene_ = file("scene.gltf", gltf.text());
  expect_at(draw({}).image, 0, 0);
}

TEST_F(RenderOption, FovIsVertical) {
  scene({far_square(8, 12)});
  for (const std::string fov : {"40", "80"}) {
    for (const std::string size : {"64x64", "128x64", "48x64"}) {
      SCOPED_TRACE(fov + " " + size);
      const double scale = pixels_per_tangent(std::stod(fov));
      const auto image = draw({"--fov", fov, "--size", size}).image;
      expect_at(image, scale * std::tan(8 * kDegree), scale * std::tan(12 * kDegree) / std::cos(8 * kDegree));
      EXPECT_EQ(image.width, std::stoi(size));
      EXPECT_EQ(image.height, kSize);
    }
  }
}

TEST_F(RenderOption, LookAtCentresTheTarget) {
  const glm::dvec3 right_up(0.6, 0.3, -1.5);
  scene({square(right_up, 0.1)}, {{"right_up", right_up}});
  for (const std::string viewing : {"fixed", "gaze"}) {
    expect_at(draw({"--look-at", "right_up", "--viewing", viewing}).image, 0, 0);
    expect_at(draw({"--look-at", "right_up", "--viewing", viewing, "--spectacles", kMinusLens}).image, 0, 0);
  }
  // Straight casting would miss: the lens turns the line of sight by degrees.
  const json bare = sight({"--look-at", "right_up"}).at("gaze_deg");
  const json worn = sight({"--look-at", "right_up", "--spectacles", kMinusLens}).at("gaze_deg");
  EXPECT_GT(bare.at(0).get<double>() - worn.at(0).get<double>(), 1.0);
}

TEST_F(RenderOption, EyeBothIsLeftThenRight) {
  scene({square({0, 0, -0.5}, 0.05)});
  const Words words{"--viewing", "fixed"};
  const auto both = draw(words + Words{"--eye", "both"}).image;
  ASSERT_EQ(both.width, 2 * kSize);
  const double step = pixels_per_tangent(60) * kHalfPd / 0.5;
  EXPECT_NEAR(centroid(both, 0, kSize).x, step, kPixel);
  EXPECT_NEAR(centroid(both, kSize, kSize).x, -step, kPixel);
  for (const std::string eye : {"left", "right"}) {
    const auto one = draw(words + Words{"--eye", eye});
    ASSERT_EQ(one.image.width, kSize);
    EXPECT_EQ(one.report.at("sight").at(0).at("eye"), eye);
    for (std::size_t i = 0; i < plane(one.image, "G").size(); ++i) {
      const std::size_t there = i / kSize * 2 * kSize + i % kSize + (eye == "left" ? 0 : kSize);
      ASSERT_EQ(plane(one.image, "G")[i], plane(both, "G")[there]);
    }
  }
}

TEST_F(RenderOption, PupillaryDistanceOfTheWearerMovesTheEyes) {
  scene({square({0, 0, -0.5}, 0.05)});
  const std::string wearer = file("wearer.json", R"({"pupillary_distance_mm": [20, 40], "right": {}, "left": {}})");
  const auto both = draw({"--viewing", "fixed", "--eye", "both", "--wearer", wearer}).image;
  EXPECT_NEAR(centroid(both, 0, kSize).x, pixels_per_tangent(60) * 0.040 / 0.5, kPixel);
  EXPECT_NEAR(centroid(both, kSize, kSize).x, -pixels_per_tangent(60) * 0.020 / 0.5, kPixel);
}

TEST_F(RenderOption, TintMultipliesRadianceThroughTheLensOnly) {
  scene({support::wall(2.0F, 8.0F, 0.5F)});
  const std::string lens =
      R"({"index": 1.5, "centre_thickness_mm": 1, "diameter_mm": 10, "front": {"type": "plane"}, "back": {"type": "plane"}})";
  const std::string tinted = file("tinted.json", R"({"right": )" + lens + R"(, "left": )" + lens +
                                                     R"(, "tint": {"transmission": [0.5, 0.25, 1]}})");
  for (const std::string mode : {"pinhole", "adof"}) {
    const auto image = draw({"--spectacles", tinted, "--mode", mode}).image;
    // Powers of two of what a half float holds exactly; in focus, so that blur mixes nothing.
    EXPECT_EQ(at_centre(image, "R"), 0.25F);
    EXPECT_EQ(at_centre(image, "G"), 0.125F);
    EXPECT_EQ(at_centre(image, "B"), 0.5F);
    for (const std::string channel : {"R", "G", "B"}) {
      EXPECT_EQ(plane(image, channel)[0], 0.5F) << "beside the lens";
    }
  }
}

// The line from the turned pupil to the place on the virtual image misses the view's own line by the pupil's sideways
// shift: nothing where the runtime's view already starts at the centre of rotation.
TEST_F(RenderOption, HeadsetPutsPixelsOnItsVirtualImage) {
  scene({far_square(30, 0, 10)});
  const Words words{"--gaze", "30,0", "--fov", "10"};
  const auto place = [&](const std::string& origin) {
    const std::string headset =
        file("headset.json", R"({"focal_distance_m": 0.5, "view_origin": ")" + origin + R"("})");
    return centroid(draw(words + Words{"--headset", headset}).image).x;
  };
  EXPECT_NEAR(centroid(draw(words).image).x, 0, kPixel);
  EXPECT_NEAR(place("rotation_centre"), 0, kPixel);
  EXPECT_NEAR(place("pupil"), pixels_per_tangent(10) * kPupilToCentre * std::sin(30 * kDegree) / 0.5, kPixel);
}

// Watson & Yellott 2012: 100 cd/m2 over a circle 60 degrees across make the pupil of a 30-year-old 2.89 mm.
TEST_F(RenderOption, HeadsetLightSetsThePupilUnlessTheWearerDoes) {
  scene({far_square(0, 0)});
  const auto blur = [&](const std::string& eye, const Words& more) {
    const std::string wearer = file("wearer.json", R"({"age": 30, "right": )" + eye + R"(, "left": {}})");
    return sight(Words{"--viewing", "fixed", "--wearer", wearer} + more).at("blur_arcmin").at(0).get<double>();
  };
  const Words headset{"--headset", file("headset.json", R"({"luminance_cd_m2": 100})")};
  const std::string own = R"({"refraction": {"sphere": -3}})";
  const std::string given = R"({"refraction": {"sphere": -3}, "pupil_diameter_mm": 5})";
  EXPECT_NEAR(blur(own, headset) / blur(own, {}), 2.89 / 3.5, 0.005 / 3.5);
  EXPECT_NEAR(blur(given, {}) / blur(own, {}), 5 / 3.5, 1e-6);
  EXPECT_EQ(blur(given, headset), blur(given, {}));
}

// A scene with edges, seen by an eye with 2.2 to 2.3 D too much: a semi-axis of 13.5 to 13.8 arcmin.
class RenderBlur : public RenderOption {
 protected:
  void SetUp() override {
    scene({support::wall(9.0F, 20.0F, 0.1F), square({0.3, 0.2, -6}, 0.3)});
    words_ = {"--wearer", file("myope.json", kMyope), "--viewing", "fixed", "--fov"};
  }
  auto planes(const Words& more) { return draw(words_ + more).image.planes; }

  Words words_;
};

// 1.4 to 1.5 px at 10 degrees, 0.41 to 0.49 from middle to corner at 34.
TEST_F(RenderBlur, ThresholdSaysWhichBlurIsNotDrawn) {
  const auto sharp = planes({"10"});
  const auto blurred = planes({"10", "--mode", "adof"});
  EXPECT_NE(blurred, sharp);
  EXPECT_EQ(planes({"10", "--mode", "adof", "--threshold", "1000"}), sharp);
  EXPECT_EQ(planes({"10", "--mode", "adof", "--threshold", "2"}), sharp);
  EXPECT_EQ(planes({"10", "--mode", "adof", "--all-effects", "--threshold", "2"}), blurred);
}

TEST_F(RenderBlur, AllEffectsDrawsBlurBelowHalfAPixel) {
  const auto sharp = planes({"34"});
  EXPECT_EQ(planes({"34", "--mode", "adof"}), sharp);
  EXPECT_NE(planes({"34", "--mode", "adof", "--all-effects"}), sharp);
  EXPECT_NE(planes({"34", "--mode", "adof", "--threshold", "0.1"}), sharp);
}

TEST_F(RenderBlur, SeedSamplesAndTargetErrorRuleTheNoise) {
  const Words dof{"10", "--mode", "dof"};
  const auto at = [&](const Words& more) { return draw(words_ + dof + more); };
  const auto first = at({"--samples", "8", "--seed", "1"});
  EXPECT_EQ(first.image.planes, at({"--samples", "8", "--seed", "1"}).image.planes);
  EXPECT_NE(first.image.planes, at({"--samples", "8", "--seed", "2"}).image.planes);
  EXPECT_EQ(first.report.at("samples"), 8);
  const auto many = at({"--samples", "512"}).report;
  EXPECT_EQ(many.at("samples"), 512);
  // 64 times the samples: an eighth of the error, or less as they are not independent.
  EXPECT_LT(many.at("error_estimate").get<double>(), 0.2 * first.report.at("error_estimate").get<double>());
  const double loose = at({"--target-error", "0.02"}).report.at("samples");
  const auto tight = at({"--target-error", "0.004"}).report;
  EXPECT_LE(tight.at("error_estimate").get<double>(), 0.004);
  EXPECT_GT(tight.at("samples").get<double>(), 2 * loose);
  EXPECT_LT(tight.at("samples").get<double>(), 4096);  // it stopped because it was good enough
}

TEST_F(RenderOption, ExposureIsInStopsOfLight) {
  scene({support::wall(2.0F, 8.0F, 0.25F)});
  EXPECT_EQ(middle({}), std::vector<int>(3, 137));  // 0.25 and 0.5 by IEC 61966-2-1
  EXPECT_EQ(middle({"--exposure", "1"}), std::vector<int>(3, 188));
}

// The wavefront of a wall 1 m away has -1 D; the hue runs from blue at LO over green to red at HI.
TEST_F(RenderOption, RangeAndColormapColourAMap) {
  scene({support::wall(1.0F, 8.0F, 0.25F)});
  const auto colour = [&](const std::string& range, const std::string& map) {
    return middle({"--mode", "power", "--viewing", "fixed", "--range", range, "--colormap", map});
  };
  const auto near = [](const std::vector<int>& a, const std::vector<int>& b) {
    return std::ranges::equal(a, b, [](int x, int y) { return std::abs(x - y) <= 3; });  // the pixel is off by half
  };
  EXPECT_TRUE(near(colour("-1,1", "hsv"), {0, 0, 255}));
  EXPECT_TRUE(near(colour("-2,0", "hsv"), {0, 255, 0}));
  EXPECT_TRUE(near(colour("-3,-1", "hsv"), {255, 0, 0}));
  EXPECT_TRUE(near(colour("-1,1", "viridis"), {68, 1, 84}));
  EXPECT_TRUE(near(colour("-3,-1", "viridis"), {253, 231, 37}));
  EXPECT_EQ(draw({"--mode", "power", "--range", "-3,-0.5"}).report.at("range"), json({-3.0, -0.5}));
}

TEST_F(RenderOption, CompareShowsALeftAndBRight) {
  scene({far_square(-15, 0), far_square(15, 0)});
  const Image8 a = draw_png({"--viewing", "fixed"});
  const Image8 b = draw_png({"--viewing", "fixed", "--spectacles", kMinusLens});
  const Image8 both = draw_png({"--viewing", "fixed", "--compare", kMinusLens});
  ASSERT_EQ(both.width, kSize);
  std::set<bool> halves_that_tell;
  for (std::size_t i = 0; i < both.rgb.size(); ++i) {
    const std::size_t column = i / 3 % kSize;
    const bool divider = column == kSize / 2 || column + 1 == kSize / 2;
    const bool right = column >= kSize / 2;
    ASSERT_EQ(both.rgb[i], divider ? 255 : right ? b.rgb[i] : a.rgb[i]) << column;
    if (a.rgb[i] != b.rgb[i]) {
      halves_that_tell.insert(right);
    }
  }
  EXPECT_EQ(halves_that_tell.size(), 2U);
}

TEST_F(RenderOption, ViewingSaysWhereRaysStartAndHowManyAccommodationsThereAre) {
  scene({support::wall(2.0F, 8.0F, 0.25F), square({-0.15, 0, -0.5}, 0.05)}, {{"near", {-0.15F, 0.0F, -0.5F}}});
  const auto extremes = [&](const std::string& viewing) {
    const auto image = draw({"--look-at", "near", "--viewing", viewing, "--channels", "all"}).image;
    return std::ranges::minmax(plane(image, "accommodation"));
  };
  const auto one_state = extremes("gaze");
  EXPECT_EQ(one_state.min, one_state.max);
  EXPECT_NEAR(one_state.min, 1.0 / std::hypot(0.15, 0.5), 0.1);  // the farther eye's demand
  EXPECT_LE(extremes("scanning").min, 0.5F);
  EXPECT_GT(extremes("scanning").max, 1.7F);
  // An eye that turns to each pixel sees from its centre of rotation.
  scene({square({kHalfPd + 0.1, 0, -0.25}, 0.01)});
  const auto place = [&](const std::string& viewing) { return centroid(draw({"--viewing", viewing}).image).x; };
  EXPECT_NEAR(place("fixed"), pixels_per_tangent(60) * 0.1 / 0.25, kPixel);
  EXPECT_NEAR(place("scanning"), pixels_per_tangent(60) * 0.1 / (0.25 + kPupilToCentre), kPixel);
}

TEST_F(RenderOption, JsonHoldsTheNumbersOfTheLineOfSight) {
  scene({support::wall(1.0F, 8.0F, 0.25F)}, {{"ahead", {0.0F, 0.0F, -1.0F}}, {"close", {0.0F, 0.0F, -0.1F}}});
  const Drawn drawn = draw({"--look-at", "ahead", "--viewing", "fixed", "--eye", "both"});
  EXPECT_EQ(drawn.report.at("size"), json({kSize, kSize}));
  ASSERT_EQ(drawn.report.at("sight").size(), 2U);
  const json row = drawn.report.at("sight").at(1);
  EXPECT_EQ(row.at("eye"), "right");
  EXPECT_EQ(row.at("status"), "ok");
  EXPECT_NEAR(row.at("power_D"), -1.0 / std::hypot(1.0, kHalfPd), 1e-6);
  EXPECT_NEAR(row.at("fixation_m"), 1.0, 1e-6);
  EXPECT_NEAR(row.at("residual_D"), 0.0, 1e-6);
  EXPECT_NEAR(row.at("accommodation_D"), -row.at("power_D").get<double>(), 1e-6);
  EXPECT_NEAR(drawn.report.at("sight").at(0).at("gaze_deg").at(0), std::atan(kHalfPd) / kDegree, 1e-4);
  // Anderson 2008, and an amplitude of one's own.
  const auto state = [&](const std::string& text) {
    return sight({"--look-at", "close", "--wearer", file("wearer.json", text)}).at("accommodation_D").get<double>();
  };
  for (const double age : {30.0, 45.0, 62.0}) {
    EXPECT_NEAR(state(R"({"right": {}, "left": {}, "age": )" + std::to_string(age) + "}"),
                7.083 / (1 + std::exp(0.2031 * (age - 36.2) - 0.6109)), 1e-6);
  }
}

TEST_F(RenderOption, TimingsAppendsRowsAndRepeatSpreadsThem) {
  scene({support::wall(1.0F, 8.0F, 0.25F)});
  const std::string table = (folder_.path() / "timings.csv").string();
  const auto lines = [&] {
    std::ifstream in(table);
    Words all;
    for (std::string line; std::getline(in, line);) {
      all.push_back(line);
    }
    return all;
  };
  const json first = draw({"--timings", table}).report;
  const json& once = first.at("stages_ms");
  const Words before = lines();
  const std::size_t parts = first.at("start_up_ms").size();
  EXPECT_GE(parts, 5U);
  ASSERT_EQ(before.size(), 1 + parts + once.size());
  for (const auto& [part, ms] : first.at("start_up_ms").items()) {
    EXPECT_GE(ms.get<double>(), 0.0) << part;
    EXPECT_TRUE(std::ranges::any_of(before, [&](const std::string& line) {
      return line.find(",start: " + part + ",") != std::string::npos;
    })) << part;
  }
  // More than the program's own text, less than the goal for a large scene.
  EXPECT_GT(first.at("peak_memory_MiB").get<double>(), 10.0);
  EXPECT_LT(first.at("peak_memory_MiB").get<double>(), 1024.0);
  const json often = draw({"--timings", table, "--repeat", "5", "--mode", "adof"}).report.at("stages_ms");
  const Words after = lines();
  ASSERT_EQ(after.size(), before.size() + parts + often.size());
  EXPECT_EQ(before, Words(after.begin(), after.begin() + std::ssize(before)));
  EXPECT_NE(after.back().find(",adof,64,64,1,2,total,"), std::string::npos) << after.back();
  EXPECT_EQ(once.at("total").at("min"), once.at("total").at("max"));
  EXPECT_LT(often.at("total").at("min"), often.at("total").at("max"));
}

TEST_F(RenderOption, ChannelsAllAddsTheWavefront) {
  scene({support::wall(2.0F, 8.0F, 0.25F)});
  const Words words{"--viewing", "fixed", "--wearer", file("myope.json", kMyope)};
  EXPECT_EQ(draw(words).image.channels.size(), 3U);
  const auto image = draw(words + Words{"--channels", "all"}).image;
  const std::set<std::string> names(image.channels.begin(), image.channels.end());
  EXPECT_EQ(names, (std::set<std::string>{"R", "G", "B", "depth", "V.hh", "V.hv", "V.vv", "blur", "accommodation"}));
  // The middle pixel begins half a pixel beside the axis.
  constexpr double kBeside = 1e-3;
  const double blur = 0.5 * 0.0035 * (2.5 / (1 + 2.5 * 0.01605) - 0.5);  // the far point at the pupil, m and D
  EXPECT_NEAR(at_centre(image, "depth"), 2.0, kBeside);
  EXPECT_NEAR(at_centre(image, "V.hh"), -0.5, kBeside);
  EXPECT_NEAR(at_centre(image, "V.vv"), -0.5, kBeside);
  EXPECT_NEAR(at_centre(image, "blur"), blur, 1e-3 * blur);
  EXPECT_EQ(at_centre(image, "accommodation"), 0.0F);
}

TEST_F(RenderOption, EmissiveAndUnlitColoursAreExact) {
  auto gltf = support::patch_gltf({square({-0.5, 0, -2}, 0.3), square({0.5, 0, -2}, 0.3)});
  json& materials = gltf.root["materials"];
  materials[0]["emissiveFactor"] = {1.0, 0.5, 0.25};
  materials[0]["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = 6.0;
  materials[1] = {{"pbrMetallicRoughness", {{"baseColorFactor", {0.125, 0.25, 0.75, 1.0}}}},
                  {"extensions", {{"KHR_materials_unlit", json::object()}}}};
  gltf.root["extensionsUsed"].push_back("KHR_materials_unlit");
  scene_ = file("scene.gltf", gltf.text());
  const std::vector<glm::vec3> wanted{{6.0F, 3.0F, 1.5F}, {0.125F, 0.25F, 0.75F}};
  for (const double x : {-0.5, 0.5}) {
    const auto image = draw({"--pose", std::to_string(x - kHalfPd) + ",0,0,0,0"}).image;
    const glm::vec3 colour(at_centre(image, "R"), at_centre(image, "G"), at_centre(image, "B"));
    EXPECT_EQ(colour, wanted[x > 0 ? 1 : 0]);
  }
}

}  // namespace
