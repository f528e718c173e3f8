#include "lenses/lens_io/lens_parts_reader.hpp"

#include <nlohmann/json.hpp>

#include "lenses/lens_io/polygon_reader.hpp"

namespace lenses::io {
namespace {

constexpr std::size_t kMostOutlinePoints = 4096;

}  // namespace

Fit read_fit(const Field& object, Fit fit) {
  object.allow_only({"vertex_distance_mm", "decentration_mm", "pantoscopic_tilt_deg", "wrap_deg"});
  object.read("vertex_distance_mm", millimetres(0.0, 100.0), fit.vertex_distance);
  object.read("pantoscopic_tilt_deg", degrees(-60.0, 60.0), fit.pantoscopic_tilt);
  object.read("wrap_deg", degrees(-60.0, 60.0), fit.wrap);
  if (const auto decentration = object.find("decentration_mm")) {
    fit.decentration = decentration->pair(millimetres(-100.0, 100.0));
  }
  return fit;
}

ReferencePoints read_reference_points(const Field& object) {
  object.allow_only({"fitting_cross", "distance", "near", "prism"});
  const auto point = [&object](std::string_view key) -> std::optional<glm::dvec2> {
    const auto found = object.find(key);
    if (!found) return std::nullopt;
    return found->pair(millimetres(-kLargestDiameterMm / 2.0, kLargestDiameterMm / 2.0));
  };
  return {point("fitting_cross"), point("distance"), point("near"), point("prism")};
}

std::vector<glm::dvec2> read_outline(const Field& object) {
  object.allow_only({"polygon_mm"});
  return read_outline_polygon(object);
}

std::vector<glm::dvec2> read_outline_polygon(const Field& object) {
  return read_polygon(object.require("polygon_mm", "an array of [x, y] points"), kMostOutlinePoints);
}

}  // namespace lenses::io
