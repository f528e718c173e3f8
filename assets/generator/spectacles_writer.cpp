#include "assets/generator/spectacles_writer.hpp"

#include <cmath>

#include "lenses/bspline_field.hpp"
#include "lenses/design/progressive_family.hpp"

namespace assets {
namespace {

using Json = nlohmann::ordered_json;
using lenses::BsplineHeightField;

// MR-8.
constexpr double kIndex = 1.6;
constexpr int kAbbe = 41;

// Lengths in files: radii to 0.1 um, nets to a picometre (their second derivatives are used).
double radius_mm(double curvature) {
  return std::round(1e7 / curvature) / 1e4;
}
Json tenths_mm(double metres) {
  const double tenths = std::round(1e4 * metres);
  if (std::fmod(tenths, 10.0) == 0.0) return static_cast<int>(tenths / 10.0);
  return tenths / 10.0;
}
double net_mm(double metres) {
  return std::round(metres * 1e12) / 1e9;
}

// An axis in TABO, as the examiner sees it, as the wearer sees it.
double wearers_axis(double tabo_deg) {
  return std::fmod(180.0 - tabo_deg, 180.0);
}

// What the front contributes to the back vertex power.
double front_vertex_power(double power, double thickness) {
  return power / (1.0 - thickness * power / kIndex);
}

Json back_surface(double power_along_axis, double power_across, double axis_deg) {
  const double along = radius_mm(power_along_axis / (1.0 - kIndex)), across = radius_mm(power_across / (1.0 - kIndex));
  if (along == across) return {{"type", "sphere"}, {"radius_mm", along}};
  return {{"type", "torus"}, {"radius_u_mm", along}, {"radius_v_mm", across}, {"axis_deg", axis_deg}, {"revolve", "u"}};
}

Json worn_upright(double decentration_y) {
  return {{"vertex_distance_mm", 13},
          {"decentration_mm", {0, tenths_mm(decentration_y)}},
          {"pantoscopic_tilt_deg", 0},
          {"wrap_deg", 0}};
}

Json net_surface(const BsplineHeightField& net) {
  Json knots = Json::array(), rows = Json::array();
  for (const double knot : net.knots_x) knots.push_back(net_mm(knot));
  for (std::size_t i = 0; i < net.count_x(); ++i) {
    Json row = Json::array();
    for (std::size_t j = 0; j < net.count_y(); ++j) row.push_back(net_mm(net.control_z[i * net.count_y() + j]));
    rows.push_back(std::move(row));
  }
  return {{"type", "bspline"}, {"knots_x_mm", knots}, {"knots_y_mm", knots}, {"control_z_mm", rows}};
}

// A progressive lens whose distance zone corrects 0.00 / cylinder x axis (TABO); nose_x: -1 right lens, +1 left lens.
Json progressive_lens(const BsplineHeightField& front, int nose_x, double cylinder, double axis_deg) {
  constexpr double kThickness = 0.002;
  const lenses::ProgressiveFamilyConfig design;
  const double front_power = front_vertex_power(design.distance_power, kThickness);
  Json lens{{"index", kIndex}, {"abbe", kAbbe}, {"centre_thickness_mm", tenths_mm(kThickness)}, {"diameter_mm", 64}};
  lens["front"] = net_surface(front);
  lens["back"] = back_surface(-front_power, cylinder - front_power, wearers_axis(axis_deg));
  lens["fit"] = worn_upright(-design.fitting_cross);
  lens["reference_points_mm"] = {
      {"fitting_cross", {0, 4}}, {"distance", {0, 8}}, {"near", {2 * nose_x, -12}}, {"prism", {0, 0}}};
  return lens;
}

// Values without an object or a list of lists inside stand on one line; the others spread, a member a line.
std::string text_of(const Json& value, const std::string& indent = "") {
  const auto flat = [](const Json& v) {
    for (const Json& member : v) {
      if (member.is_object() || (member.is_array() && !member.empty() && member.size() > 3)) return false;
    }
    return true;
  };
  if (!value.is_structured()) return value.dump();
  const bool object = value.is_object(), spread = !flat(value);
  std::string text = object ? "{" : "[";
  bool first = true;
  for (const auto& [key, member] : value.items()) {
    if (!first) text += spread ? "," : ", ";
    if (spread) text += "\n" + indent + "  ";
    if (object) text += Json(key).dump() + ": ";
    text += text_of(member, indent + "  ");
    first = false;
  }
  if (spread) text += "\n" + indent;
  return text + (object ? "}" : "]");
}

std::string pair_text(const std::string& name, const Json& right, const Json& left) {
  return text_of({{"version", 1}, {"name", name}, {"right", right}, {"left", left}}) + "\n";
}

}  // namespace

BsplineHeightField progressive_front_right(std::size_t count) {
  const lenses::ProgressiveFamily surface;
  return lenses::fit_height_field([&](double x, double y) { return surface.height(-x, y); }, count, 0.035);
}

Json single_vision_lens(const SingleVision& order) {
  const double front_power = front_vertex_power(order.base_curve, order.centre_thickness);
  Json lens{{"index", kIndex},
            {"abbe", kAbbe},
            {"centre_thickness_mm", tenths_mm(order.centre_thickness)},
            {"diameter_mm", tenths_mm(order.diameter)}};
  lens["front"] = {{"type", "sphere"}, {"radius_mm", radius_mm(order.base_curve / (kIndex - 1.0))}};
  lens["back"] = back_surface(order.sphere - front_power, order.sphere + order.cylinder - front_power,
                              std::fmod(180.0 - order.axis_deg, 180.0));
  lens["fit"] = worn_upright(0.0);
  return lens;
}

std::map<std::string, std::string> spectacles_files() {
  const BsplineHeightField right = progressive_front_right(), left = mirrored(right);
  const auto both = [](const std::string& name, const SingleVision& order) {
    const Json lens = single_vision_lens(order);
    return pair_text(name, lens, lens);
  };
  std::map<std::string, std::string> files;
  files["spectacles/presbyopia_bspline_sphere.json"] = pair_text(
      "Progressive, plano, addition 2.00", progressive_lens(right, -1, 0.0, 0.0), progressive_lens(left, 1, 0.0, 0.0));
  files["spectacles/presbyopia_bspline_torus.json"] =
      pair_text("Progressive, 0.00 -0.75 x 175 and x 5, addition 2.00", progressive_lens(right, -1, -0.75, 175.0),
                progressive_lens(left, 1, -0.75, 5.0));
  // Base curves by Vogel's rule: sphere + 6 for plus lenses, sphere / 2 + 6 for minus lenses, to the nearest dioptre.
  files["spectacles/myopia.json"] =
      both("Single vision, -6.00", {.sphere = -6.0, .base_curve = 3.0, .centre_thickness = 0.0012});
  files["spectacles/hyperopia.json"] =
      both("Single vision, +4.00", {.sphere = 4.0, .base_curve = 10.0, .centre_thickness = 0.0043, .diameter = 0.060});
  files["spectacles/astigmatism.json"] =
      both("Single vision, -1.00 -2.50 x 20",
           {.sphere = -1.0, .cylinder = -2.5, .axis_deg = 20.0, .base_curve = 5.0, .centre_thickness = 0.0015});
  files["spectacles/emmetropia.json"] = both("Plano", {});
  files["lenses/progressive_add200_right.json"] = text_of(progressive_lens(right, -1, 0.0, 0.0)) + "\n";
  return files;
}

std::string fine_net_pair() {
  const BsplineHeightField right = progressive_front_right(100);
  return pair_text("Progressive, plano, addition 2.00, 100 x 100 control points", progressive_lens(right, -1, 0.0, 0.0),
                   progressive_lens(mirrored(right), 1, 0.0, 0.0));
}

}  // namespace assets
