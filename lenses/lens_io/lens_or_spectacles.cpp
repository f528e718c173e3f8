#include "lenses/lens_io/lens_or_spectacles.hpp"

#include <nlohmann/json.hpp>

#include "lenses/lens_io/json_document.hpp"
#include "lenses/lens_io/lens_io.hpp"

namespace lenses {

std::variant<Lens, Spectacles> read_lens_or_spectacles(const std::string& path) {
  const std::string text = io::read_text_file(path);
  const nlohmann::json document = io::parse_json(text, {path, ""});
  const bool pair = document.is_object() && (document.contains("right") || document.contains("left"));
  if (pair) return parse_spectacles(text, path);
  return parse_lens(text, path);
}

}  // namespace lenses
