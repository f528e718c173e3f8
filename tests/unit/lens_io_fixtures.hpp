// Good files of every kind, and the check that a changed one is refused at the right field.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "lenses/lens_io/lens_io.hpp"
#include "tracking/input_error.hpp"

namespace lens_io_fixtures {

using nlohmann::json;
using tracking::InputError;

inline constexpr double kDegree = std::numbers::pi / 180.0;

inline const char* const kSphere = R"({"type": "sphere", "radius_mm": 88.0})";
inline const char* const kTorus =
    R"({"type": "torus", "radius_u_mm": 95.0, "radius_v_mm": -102.0, "axis_deg": 200, "revolve": "v"})";
inline const char* const kConic =
    R"({"type": "conic", "radius_mm": 70, "conic_constant": -1.5, "even_coefficients_mm": [1e-7, -2e-11]})";

inline json bspline() {
  json rows = json::array();
  for (int i = 0; i < 5; ++i) rows.push_back({0.1 * i, 0.2, 0.3, 0.4});
  return {{"type", "bspline"},
          {"knots_x_mm", {-30, -30, -30, -30, 0, 30, 30, 30, 30}},
          {"knots_y_mm", {-30, -20, -10, 0, 10, 20, 30, 40}},
          {"control_z_mm", rows}};
}

inline json bspline_surface() {
  json rows = json::array();
  for (int i = 0; i < 4; ++i) {
    json row = json::array();
    for (int j = 0; j < 5; ++j) row.push_back({10.0 * i, 9.0 * j, 0.25 * i * j});
    rows.push_back(row);
  }
  return {{"type", "bspline_surface"},
          {"knots_u", {0, 0, 0, 0, 1, 1, 1, 1}},
          {"knots_v", {-0.3, -0.2, -0.1, 0, 0.1, 0.2, 0.3, 0.4, 0.5}},
          {"control_mm", rows}};
}

inline json segment_surface() {
  return json::parse(R"({"type": "segment", "base": {"type": "sphere", "radius_mm": 88},
    "segment": {"type": "torus", "radius_u_mm": 60, "radius_v_mm": 61, "axis_deg": 30, "revolve": "u",
      "decentration_mm": [2.5, -8], "slope": [0.01, -0.02], "height_mm": 0.05},
    "boundary_mm": [[-11.5, -3], [16.5, -3], [14, -14], [2.5, -17.25], [-9, -14]], "decentration_mm": [1, 0],
    "slope": [0.03, 0.04], "height_mm": -0.1})");
}

inline json good_lens() {
  json lens = json::parse(R"({"version": 1, "name": "a lens", "index": 1.6, "abbe": 41, "centre_thickness_mm": 2.0,
    "diameter_mm": 65, "fit": {"vertex_distance_mm": 12, "decentration_mm": [1, -2], "pantoscopic_tilt_deg": 8,
    "wrap_deg": -5}, "reference_points_mm": {"fitting_cross": [0, 4], "near": [-2.5, -12]},
    "outline": {"polygon_mm": [[26, 0], [0, 20], [-26, 0], [0, -20]]}, "attached_to": "eye", "_maker": {"any": 1}})");
  lens["front"] = json::parse(kSphere);
  lens["back"] = json::parse(kTorus);
  return lens;
}

inline json good_spectacles() {
  json left = good_lens();
  left["back"] = bspline();
  left["front"] = json::parse(kConic);
  return {{"name", "a pair"}, {"right", good_lens()}, {"left", left}, {"tint", {{"transmission", {0.9, 0.8, 0.7}}}}};
}

inline json good_wearer() {
  return json::parse(R"({"version": 1, "name": "W", "age": 52, "pupillary_distance_mm": [31, 32.5],
    "right": {"axial_length_mm": 24, "pupil_diameter_mm": 3, "accommodation_amplitude_D": 1.5,
      "refraction": {"sphere": -2, "cylinder": -0.5, "axis": 190}, "refraction_vertex_mm": 12,
      "entrance_pupil_depth_mm": 3, "centre_of_rotation_depth_mm": 13,
      "zernike_um": {"pupil_diameter_mm": 6, "coefficients": [0, 0, 0, 0.1, -0.2]}},
    "left": {"relaxed_power_D": [41, 40.5], "power_axis_deg": 30},
    "viewer": {"right": {"refraction": {"sphere": -3}, "worn_in_headset": "contacts",
      "accommodation_amplitude_D": 2}}})");
}

inline json good_headset() {
  return json::parse(R"({"focal_distance_m": 1.3, "pixels_per_degree": 51, "luminance_cd_m2": 150,
    "view_origin": "rotation_centre"})");
}

using Parse = std::function<void(const std::string&)>;
inline const Parse kLens = [](const std::string& text) { (void)lenses::parse_lens(text, "f.json"); };
inline const Parse kSpectacles = [](const std::string& text) { (void)lenses::parse_spectacles(text, "f.json"); };
inline const Parse kWearer = [](const std::string& text) { (void)lenses::parse_wearer(text, "f.json"); };
inline const Parse kHeadset = [](const std::string& text) { (void)lenses::parse_headset(text, "f.json"); };

// Expects the text to be refused at this field for a reason that contains `reason`, in one line.
inline void expect_refused(const Parse& parse, const std::string& text, const std::string& field,
                           const std::string& reason) {
  try {
    parse(text);
    ADD_FAILURE() << "was read; expected an error at " << field << " with: " << reason;
  } catch (const InputError& error) {
    EXPECT_EQ(error.file(), "f.json");
    EXPECT_EQ(error.field(), field) << error.what();
    EXPECT_NE(error.reason().find(reason), std::string::npos) << error.reason() << "\nlacks: " << reason;
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << "one line on stderr";
  }
}

// One change to a good document: the value at a JSON pointer replaced ("-" in `value` removes it).
struct Change {
  const char* pointer;
  const char* value;
  const char* field;
  const char* reason;
};

inline void expect_all_refused(const Parse& parse, const json& good, const std::vector<Change>& changes) {
  ASSERT_NO_THROW(parse(good.dump()));
  for (const Change& change : changes) {
    SCOPED_TRACE(std::string(change.pointer) + " = " + change.value);
    json document = good;
    const json::json_pointer pointer(change.pointer);
    if (std::string(change.value) == "-") {
      json& parent = document.at(pointer.parent_pointer());
      if (parent.is_array()) {
        parent.erase(std::stoul(pointer.back()));
      } else {
        parent.erase(pointer.back());
      }
    } else {
      document[pointer] = json::parse(change.value);
    }
    expect_refused(parse, document.dump(), change.field, change.reason);
  }
}

inline json lens_with_back(const json& surface) {
  json lens = good_lens();
  lens["back"] = surface;
  return lens;
}

}  // namespace lens_io_fixtures
