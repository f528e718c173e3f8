#include "lenses/lens_io/lens_reader.hpp"

#include <nlohmann/json.hpp>

#include "lenses/lens_io/lens_io.hpp"
#include "lenses/lens_io/lens_parts_reader.hpp"
#include "lenses/lens_io/placement_reader.hpp"
#include "lenses/lens_io/prescription_reader.hpp"
#include "lenses/lens_io/surface_reader.hpp"

namespace lenses {
namespace io {
Lens read_lens_object(const Field& object, std::optional<Side> side) {
  if (object.find("prescription")) return read_prescription_lens(object, side);
  for (const std::string_view key : {"design", "material"}) {
    if (const auto found = object.find(key))
      found->fail("is given without a prescription; it is allowed only beside one");
  }
  object.allow_only_in_root({"index", "abbe", "centre_thickness_mm", "diameter_mm", "front", "back", "fit",
                             "reference_points_mm", "outline", "attached_to", "order"});
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
  if (const auto fit = object.find("fit")) lens.fit = read_fit(*fit, {});
  if (const auto points = object.find("reference_points_mm")) lens.reference_points = read_reference_points(*points);
  if (const auto outline = object.find("outline")) lens.outline = read_outline(*outline);
  if (const auto attached_to = object.find("attached_to")) {
    lens.attached_to =
        attached_to->choice<Lens::AttachedTo>({{"head", Lens::AttachedTo::head}, {"eye", Lens::AttachedTo::eye}});
  }
  if (const auto order = object.find("order")) lens.order = read_order(*order, side);
  return lens;
}

}  // namespace io

Lens parse_lens(std::string_view text, const std::string& file) {
  const io::Source source{file, ""};
  const nlohmann::json document = io::parse_json(text, source);
  return io::read_lens_object(io::Field(document, source), std::nullopt);
}

std::vector<glm::dvec2> read_outline(const std::string& path) {
  const io::Source source{path, ""};
  const nlohmann::json document = io::parse_json(io::read_text_file(path), source);
  const io::Field object(document, source);
  object.allow_only_in_root({"polygon_mm"});
  return io::read_outline_polygon(object);
}

Lens read_lens(const std::string& path) {
  return parse_lens(io::read_text_file(path), path);
}

}  // namespace lenses
