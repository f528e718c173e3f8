#include <nlohmann/json.hpp>

#include "lenses/lens_io/lens_io.hpp"
#include "lenses/lens_io/lens_reader.hpp"

namespace lenses {

Spectacles parse_spectacles(std::string_view text, const std::string& file) {
  const io::Source source{file, ""};
  const nlohmann::json document = io::parse_json(text, source);
  const io::Field object(document, source);
  object.allow_only_in_root({"name", "right", "left", "tint"});
  Spectacles result;
  if (const auto name = object.find("name")) result.name = name->text();
  result.lens = {io::read_lens_object(object.require("right", "a lens"), Side::right),
                 io::read_lens_object(object.require("left", "a lens"), Side::left)};
  if (const auto tint = object.find("tint")) {
    tint->allow_only({"transmission"});
    const io::Field transmission = tint->require("transmission", "an array of 3 numbers from 0 to 1");
    result.tint_transmission = transmission.triple(io::plain(0.0, 1.0));
  }
  return result;
}

Spectacles read_spectacles(const std::string& path) {
  return parse_spectacles(io::read_text_file(path), path);
}

}  // namespace lenses
