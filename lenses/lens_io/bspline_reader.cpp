#include "lenses/lens_io/bspline_reader.hpp"

#include <nlohmann/json.hpp>

#include "lenses/lens_io/placement_reader.hpp"

namespace lenses::io {
namespace {

constexpr std::size_t kOrder = 4;  // bicubic
constexpr std::size_t kFewest = 4, kMost = 100;
constexpr double kReachMm = 1e3;
// Knots nearer than this part of the domain, yet not equal, come from rounding, and a basis function divides by their
// distance.
constexpr double kLeastSpan = 1e-9;

// Files of other programs hold knots that only nearly repeat, or run backwards; the field is the knot at fault.
void check_knots(const Field& field, const std::vector<double>& knots) {
  const std::size_t count = knots.size() - kOrder;
  const double domain = knots[count] - knots[kOrder - 1];
  const auto fail_at = [&field](std::size_t i, const std::string& reason) {
    field.elements(0, kMost + kOrder, "numbers")[i].fail(reason);
  };
  for (std::size_t i = 1; i < knots.size(); ++i) {
    if (knots[i] < knots[i - 1]) fail_at(i, "is less than the knot before it; knots must not decrease");
    if (i >= kOrder && knots[i] == knots[i - kOrder]) fail_at(i, "repeats a fourth time; a knot may be given 4 times");
  }
  if (domain <= 0.0) {
    field.fail("leave no valid domain; knot 3 must be less than knot " + std::to_string(count) + " (from 0)");
  }
  for (std::size_t i = 1; i < knots.size(); ++i) {
    const double span = knots[i] - knots[i - 1];
    if (span > 0.0 && span < kLeastSpan * domain) {
      fail_at(i, "differs from the knot before it by less than 1e-9 of the domain; knots must be equal or apart");
    }
  }
}

std::vector<double> read_knots(const Field& surface, std::string_view key, const Limits& limits) {
  const Field field = surface.require(key, "an array of knots, 4 more than control points");
  std::vector<double> knots = field.numbers(limits, kFewest + kOrder, kMost + kOrder);
  check_knots(field, knots);
  return knots;
}

// The rows of a net that is not ragged, its size checked against the knots.
std::vector<Field> read_rows(const Field& surface, std::string_view key, std::size_t rows, std::size_t row_length) {
  const std::string expected = "an array of " + std::to_string(rows) + " rows of " + std::to_string(row_length) +
                               ", as the knots have 4 more entries than the net";
  const Field net = surface.require(key, expected);
  if (!net.value().is_array() || net.value().size() != rows) net.fail_type(expected);
  std::vector<Field> result = net.elements(rows, rows, "rows");
  for (const Field& row : result) {
    if (!row.value().is_array() || row.value().size() != row_length) {
      row.fail_type("a row of " + std::to_string(row_length) + ", as the knots have 4 more entries than the net");
    }
  }
  return result;
}

// A patch that is a graph over the lens plane and seen from the right side has x along u and y along v, or a turn of
// that: the mean edges of its net then span a positive area. (A local fold passes here.)
bool net_faces_the_eye(const BsplineSurface& surface) {
  const std::size_t m = surface.count_u(), n = surface.count_v();
  glm::dvec3 along_u{0.0}, along_v{0.0};
  for (std::size_t j = 0; j < n; ++j) along_u += surface.control[(m - 1) * n + j] - surface.control[j];
  for (std::size_t i = 0; i < m; ++i) along_v += surface.control[i * n + n - 1] - surface.control[i * n];
  return along_u.x * along_v.y - along_u.y * along_v.x > 0.0;
}

}  // namespace

BsplineHeightField read_bspline_height_field(const Field& surface) {
  surface.allow_only({"type", "knots_x_mm", "knots_y_mm", "control_z_mm"}, kPlacementKeys);
  const Limits reach = millimetres(-kReachMm, kReachMm);
  BsplineHeightField result;
  result.knots_x = read_knots(surface, "knots_x_mm", reach);
  result.knots_y = read_knots(surface, "knots_y_mm", reach);
  for (const Field& row : read_rows(surface, "control_z_mm", result.count_x(), result.count_y())) {
    const std::vector<double> heights = row.numbers(reach, result.count_y(), result.count_y());
    result.control_z.insert(result.control_z.end(), heights.begin(), heights.end());
  }
  return result;
}

BsplineSurface read_bspline_surface(const Field& surface) {
  surface.allow_only({"type", "knots_u", "knots_v", "control_mm"}, kPlacementKeys);
  BsplineSurface result;
  result.knots_u = read_knots(surface, "knots_u", plain(-1e6, 1e6));
  result.knots_v = read_knots(surface, "knots_v", plain(-1e6, 1e6));
  const std::size_t row_length = result.count_v();
  for (const Field& row : read_rows(surface, "control_mm", result.count_u(), row_length)) {
    for (const Field& point : row.elements(row_length, row_length, "points")) {
      result.control.push_back(point.triple(millimetres(-kReachMm, kReachMm)));
    }
  }
  if (!net_faces_the_eye(result)) {
    surface.require("control_mm", "a net")
        .fail("is mirrored or has no area; seen with x to the right and y up, v must run counter-clockwise from u");
  }
  return result;
}

}  // namespace lenses::io
