#include <nlohmann/json.hpp>

#include "lenses/lens_io/json_fields.hpp"
#include "lenses/lens_io/lens_io.hpp"

namespace lenses {

HeadsetDisplay parse_headset(std::string_view text, const std::string& file) {
  const io::Source source{file, ""};
  const nlohmann::json document = io::parse_json(text, source);
  const io::Field object(document, source);
  object.allow_only_in_root({"focal_distance_m", "pixels_per_degree", "luminance_cd_m2", "view_origin"});
  HeadsetDisplay result;
  object.read("focal_distance_m", io::plain(0.1, 1e6), result.focal_distance);
  object.read("pixels_per_degree", io::plain(1.0, 1000.0), result.pixels_per_degree);
  object.read("luminance_cd_m2", io::plain(0.01, 1e5), result.luminance);
  if (const auto origin = object.find("view_origin")) {
    using Origin = HeadsetDisplay::ViewOrigin;
    result.view_origin =
        origin->choice<Origin>({{"pupil", Origin::pupil}, {"rotation_centre", Origin::rotation_centre}});
  }
  return result;
}

HeadsetDisplay read_headset(const std::string& path) {
  return parse_headset(io::read_text_file(path), path);
}

}  // namespace lenses
