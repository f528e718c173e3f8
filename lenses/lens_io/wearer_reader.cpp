#include <nlohmann/json.hpp>

#include "lenses/lens_io/eye_reader.hpp"
#include "lenses/lens_io/lens_io.hpp"
#include "lenses/lens_io/live_config_reader.hpp"

namespace lenses {
namespace {

constexpr std::array<std::string_view, 2> kSides{"right", "left"};  // in the order of Side

constexpr io::Limits kAge = io::plain(1.0, 120.0);

void read_viewers(const io::Field& object, Wearer& wearer) {
  object.allow_only({"right", "left", "age"});
  object.read("age", kAge, wearer.viewer_age);
  for (std::size_t side = 0; side < kSides.size(); ++side) {
    if (const auto viewer = object.find(kSides[side])) wearer.viewer[side] = io::read_viewer_object(*viewer);
  }
}

}  // namespace

Wearer parse_wearer(std::string_view text, const std::string& file) {
  const io::Source source{file, ""};
  const nlohmann::json document = io::parse_json(text, source);
  const io::Field object(document, source);
  object.allow_only_in_root(
      {"name", "age", "pupillary_distance_mm", "right", "left", "viewer", "accommodation", "pupil", "tracking"});
  Wearer wearer;
  if (const auto name = object.find("name")) wearer.name = name->text();
  object.read("age", kAge, wearer.age);
  if (const auto distances = object.find("pupillary_distance_mm")) {
    const glm::dvec2 right_left = distances->pair(io::millimetres(15.0, 45.0));
    wearer.pupillary_distance = {right_left.x, right_left.y};
  }
  for (std::size_t side = 0; side < kSides.size(); ++side) {
    if (const auto eye = object.find(kSides[side])) wearer.eye[side] = io::read_eye_object(*eye);
  }
  if (const auto viewers = object.find("viewer")) read_viewers(*viewers, wearer);
  wearer.live = io::read_live_config(object);
  return wearer;
}

Wearer read_wearer(const std::string& path) {
  return parse_wearer(io::read_text_file(path), path);
}

}  // namespace lenses
