// A scene's JSON as a tree of bounded depth and size.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace render {

// For messages: no control characters, and not a whole data URI.
[[nodiscard]] std::string one_line(std::string text);

// Throws tracking::InputError{file} for what is no JSON, nests too deep or holds too many values.
[[nodiscard]] nlohmann::json parse_gltf_json(const std::string& file, std::string_view text);

}  // namespace render
