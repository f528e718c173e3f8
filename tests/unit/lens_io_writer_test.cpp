// What is written reads back the same, and the schemas name the keys that the readers allow.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <random>
#include <set>

#include "lens_io_fixtures.hpp"

namespace {

using namespace lens_io_fixtures;

// Compares two JSON texts value by value: numbers to 1e-12 relative, or 1e-12 where both are nearly 0.
void expect_same(const json& a, const json& b, const std::string& path) {
  if (a.is_number() && b.is_number()) {
    const double x = a.get<double>(), y = b.get<double>();
    EXPECT_LE(std::abs(x - y), 1e-12 * std::max(std::abs(x), std::abs(y))) << path << ": " << x << " and " << y;
    return;
  }
  ASSERT_EQ(a.type(), b.type()) << path;
  ASSERT_EQ(a.size(), b.size()) << path;
  if (!a.is_structured()) {
    EXPECT_EQ(a, b) << path;
    return;
  }
  for (const auto& [key, value] : a.items()) {
    const std::string inner = path + "/" + key;
    if (a.is_array()) {
      expect_same(value, b.at(std::stoul(key)), inner);
    } else {
      ASSERT_TRUE(b.contains(key)) << inner;
      expect_same(value, b.at(key), inner);
    }
  }
}

TEST(Writers, ReadBackTheSame) {
  for (const json& back : {json::parse(kSphere), json::parse(kTorus), json::parse(kConic), bspline(), bspline_surface(),
                           segment_surface(), json{{"type", "plane"}}}) {
    json wanted = lens_with_back(back);
    wanted.erase("name");
    wanted.erase("_maker");
    if (back.at("type") == "torus") wanted["back"]["axis_deg"] = 20;
    const std::string once = lenses::to_json(lenses::parse_lens(lens_with_back(back).dump(), "f.json"));
    expect_same(wanted, json::parse(once), back.at("type"));
    EXPECT_EQ(lenses::to_json(lenses::parse_lens(once, "f.json")), once);
  }
  const std::string pair = lenses::to_json(lenses::parse_spectacles(good_spectacles().dump(), "f.json"));
  EXPECT_EQ(lenses::to_json(lenses::parse_spectacles(pair, "f.json")), pair);
  lenses::Lens segmented = lenses::parse_lens(lens_with_back(segment_surface()).dump(), "f.json");
  segmented.front_placement.slope.y = 1.0 / 3.0;
  EXPECT_EQ(lenses::parse_lens(lenses::to_json(segmented), "f.json").back, segmented.back);
  EXPECT_EQ(lenses::parse_lens(lenses::to_json(segmented), "f.json").front_placement, segmented.front_placement);
  const std::string wearer = lenses::to_json(lenses::parse_wearer(good_wearer().dump(), "f.json"));
  EXPECT_EQ(lenses::to_json(lenses::parse_wearer(wearer, "f.json")), wearer);
  EXPECT_NE(wearer.find("\"coefficients\": [0, 0, 0, 0.1, -0.2]"), std::string::npos) << "short decimals stay\n"
                                                                                      << wearer;
  const std::string headset = lenses::to_json(lenses::parse_headset(good_headset().dump(), "f.json"));
  EXPECT_EQ(lenses::to_json(lenses::parse_headset(headset, "f.json")), headset);
}

// Random SI values, so that nothing is a round number in the file's units.
TEST(Writers, KeepRandomValues) {
  const unsigned seed = 20240611;
  std::mt19937 random(seed);
  const auto uniform = [&random](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const auto close = [](double a, double b) { return std::abs(a - b) <= 1e-12 * std::abs(a); };
  for (int i = 0; i < 500; ++i) {
    lenses::Lens lens;
    lens.diameter = uniform(0.01, 0.1);
    lens.fit.wrap = uniform(-0.5, 0.5);
    lens.front = lenses::Torus{uniform(-200, 200), uniform(-200, 200), uniform(0.0, 3.14), lenses::Torus::Revolve::u};
    lens.back = lenses::Conic{uniform(-20, 20), uniform(-3, 3), {uniform(-900, 900), uniform(-9e5, 9e5)}};
    const lenses::Lens read = lenses::parse_lens(lenses::to_json(lens), "f.json");
    const auto &front = std::get<lenses::Torus>(read.front), &wanted = std::get<lenses::Torus>(lens.front);
    const auto &back = std::get<lenses::Conic>(read.back), &conic = std::get<lenses::Conic>(lens.back);
    EXPECT_TRUE(close(lens.diameter, read.diameter) && close(lens.fit.wrap, read.fit.wrap) &&
                close(wanted.curvature_u, front.curvature_u) && close(wanted.curvature_v, front.curvature_v) &&
                close(wanted.axis, front.axis) && close(conic.curvature, back.curvature) &&
                close(conic.even_coefficients[0], back.even_coefficients[0]) &&
                close(conic.even_coefficients[1], back.even_coefficients[1]))
        << "seed " << seed << ", lens " << i;
  }
}

// Defaults are SI literals, whose millimetres are not the decimals one would write down.
TEST(Writers, WriteDefaultsAsShortDecimals) {
  const std::string text = lenses::to_json(lenses::Wearer{});
  EXPECT_NE(text.find("\"entrance_pupil_depth_mm\": 3.05,"), std::string::npos) << text;
  EXPECT_NEAR(lenses::parse_wearer(text, "f.json").eye[0].entrance_pupil_depth, 0.00305, 1e-18) << "one rounding";
}

TEST(Writers, RefuseWhatIsNotFinite) {
  lenses::Lens lens;
  lens.front = lenses::Sphere{std::nan("")};
  EXPECT_THROW((void)lenses::to_json(lens), std::invalid_argument) << "null would read back as flat";
  lenses::Wearer wearer;
  wearer.age = INFINITY;
  EXPECT_THROW((void)lenses::to_json(wearer), std::invalid_argument);
}

TEST(Writers, WriteAnyName) {
  lenses::Wearer wearer;
  wearer.name = "a\"b\n\xff";
  EXPECT_EQ(lenses::parse_wearer(lenses::to_json(wearer), "f.json").name, "a\"b\n\xEF\xBF\xBD");
}

std::set<std::string> allowed_keys(const Parse& parse, const json& with_unknown_key) {
  try {
    parse(with_unknown_key.dump());
  } catch (const InputError& error) {
    std::string list = error.reason().substr(error.reason().find("allowed: ") + 9);
    std::set<std::string> keys;
    for (std::size_t start = 0; start < list.size();) {
      const std::size_t comma = std::min(list.find(", ", start), list.size());
      keys.insert(list.substr(start, comma - start));
      start = comma + 2;
    }
    return keys;
  }
  return {};
}

// The schemas are for editors and other programs; they must name the very keys that the readers allow.
TEST(Schemas, NameTheKeysThatReadersAllow) {
  const auto schema = [](const std::string& name, const std::string& pointer) {
    std::ifstream file(std::string(VERGENCE_ASSETS) + "/schemas/" + name + ".schema.json");
    const json properties = json::parse(file).at(json::json_pointer(pointer + "/properties"));
    std::set<std::string> keys;
    for (const auto& [key, unused] : properties.items()) keys.insert(key);
    for (const char* annotation : {"$schema", "version", "comment", "note"}) keys.erase(annotation);
    return keys;
  };
  const json unknown{{"unknown", 1}};
  const auto in = [&unknown](const char* pointer, json base) {
    base[json::json_pointer(pointer)].update(unknown);
    return base;
  };
  std::set<std::string> lens = schema("lens", "/$defs/lens_of_surfaces");
  lens.erase("name");
  EXPECT_EQ(allowed_keys(kLens, unknown), lens);
  std::set<std::string> ordered = schema("lens", "/$defs/lens_of_prescription");
  ordered.erase("name");
  const json order = json::parse(R"({"prescription": {"sphere": 1, "prism": [{"magnitude": 1, "base": 0}]}})");
  EXPECT_EQ(allowed_keys(kLens, in("", order)), ordered);
  EXPECT_EQ(allowed_keys(kLens, in("/prescription", order)), schema("lens", "/$defs/prescription"));
  EXPECT_EQ(allowed_keys(kLens, in("/prescription/prism/0", order)), schema("lens", "/$defs/prism"));
  json made = good_lens();
  made["order"] = {{"ordered", order["prescription"]}, {"compensated", order["prescription"]}};
  EXPECT_EQ(allowed_keys(kLens, in("/order", made)), schema("lens", "/$defs/order"));
  EXPECT_EQ(allowed_keys(kLens, in("/order/compensated", made)), schema("lens", "/$defs/compensated_prescription"));
  EXPECT_EQ(allowed_keys(kSpectacles, unknown), schema("spectacles", ""));
  EXPECT_EQ(allowed_keys(kWearer, unknown), schema("wearer", ""));
  std::set<std::string> headset = schema("headset", "");
  headset.erase("name");
  EXPECT_EQ(allowed_keys(kHeadset, unknown), headset);
  for (const json& surface :
       {json::parse(kSphere), json::parse(kTorus), json::parse(kConic), bspline(), bspline_surface(), segment_surface(),
        json{{"type", "file"}, {"path", "x.sdf"}}, json{{"type", "plane"}}}) {
    const std::string type = surface.at("type");
    EXPECT_EQ(allowed_keys(kLens, in("/back", lens_with_back(surface))), schema("lens", "/$defs/" + type)) << type;
  }
  EXPECT_EQ(allowed_keys(kLens, in("/fit", good_lens())), schema("lens", "/$defs/fit"));
  EXPECT_EQ(allowed_keys(kWearer, in("/right", good_wearer())), schema("wearer", "/$defs/eye"));
  EXPECT_EQ(allowed_keys(kWearer, in("/right/refraction", good_wearer())), schema("wearer", "/$defs/refraction"));
  EXPECT_EQ(allowed_keys(kWearer, in("/viewer/right", good_wearer())), schema("wearer", "/$defs/viewer"));
  EXPECT_EQ(allowed_keys(kWearer, in("/viewer", good_wearer())), schema("wearer", "/properties/viewer"));
  json live = good_wearer();
  live.update(json::parse(R"({"accommodation": {}, "pupil": {}, "tracking": {"target": {}, "saccade": {}}})"));
  for (const char* part : {"accommodation", "pupil", "tracking"}) {
    EXPECT_EQ(allowed_keys(kWearer, in((std::string("/") + part).c_str(), live)),
              schema("wearer", std::string("/$defs/") + part));
  }
  EXPECT_EQ(allowed_keys(kWearer, in("/tracking/target", live)), schema("wearer", "/$defs/one_euro"));
  EXPECT_EQ(allowed_keys(kWearer, in("/tracking/saccade", live)), schema("wearer", "/$defs/saccade"));
}

}  // namespace
