#include "lenses/lens_io/lens_reader.hpp"

#include <nlohmann/json.hpp>

#include "lenses/lens_io/lens_io.hpp"
#include "lenses/lens_io/placement_reader.hpp"
#include "lenses/lens_io/polygon_reader.hpp"
#include "lenses/lens_io/surface_reader.hpp"

namespace lenses {
namespace io {
namespace {

constexpr double kLargestDiameterMm = 500.0;
constexpr std::size_t kMostOutlinePoints = 4096;

Fit read_fit(const Field& object) {
  object.allow_only({"vertex_distance_mm", "decentration_mm", "pantoscopic_tilt_deg", "wrap_deg"});
  Fit fit;
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
  return read_polygon(object.require("polygon_mm", "an array of [x, y] points"), kMostOutlinePoints);
}

// The other way to describe a lens: by what it does. Its keys are known, so that they are not called unknown.
void refuse_prescription(const Field& object) {
  for (const std::string_view key : {"prescription", "design", "material"}) {
    if (const auto found = object.find(key)) {
      found->fail(
          "is not read in this version; a lens must be given by index, centre_thickness_mm, diameter_mm, front and "
          "back");
    }
  }
}

}  // namespace

Lens read_lens_object(const Field& object) {
  refuse_prescription(object);
  object.allow_only_in_root({"index", "abbe", "centre_thickness_mm", "diameter_mm", "front", "back", "fit",
                             "reference_points_mm", "outline", "attached_to"});
  Lens lens;
  lens.index = object.required_number("index", plain(1.0, 4.0));
  object.read("abbe", plain(5.0, 200.0), lens.abbe);
  lens.centre_thickness = object.required_number("centre_thickness_mm", millimetres(0.0, 200.0));
  lens.diameter = object.required_number("diameter_mm", {0.0, kLargestDiameterMm, Limits::Unit::millimetres, true});
  const Field front = object.require("front", "a surface");
  lens.front = read_surface(front);
  lens.front_placement = read_placement(front);
  const Field back = object.require("back", "a surface");
  lens.back = read_surface(back);
  lens.back_placement = read_placement(back);
  if (const auto fit = object.find("fit")) lens.fit = read_fit(*fit);
  if (const auto points = object.find("reference_points_mm")) lens.reference_points = read_reference_points(*points);
  if (const auto outline = object.find("outline")) lens.outline = read_outline(*outline);
  if (const auto attached_to = object.find("attached_to")) {
    lens.attached_to =
        attached_to->choice<Lens::AttachedTo>({{"head", Lens::AttachedTo::head}, {"eye", Lens::AttachedTo::eye}});
  }
  return lens;
}

}  // namespace io

Lens parse_lens(std::string_view text, const std::string& file) {
  const io::Source source{file, ""};
  const nlohmann::json document = io::parse_json(text, source);
  return io::read_lens_object(io::Field(document, source));
}

Lens read_lens(const std::string& path) {
  return parse_lens(io::read_text_file(path), path);
}

}  // namespace lenses
