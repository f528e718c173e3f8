// Text to a JSON value, with what the JSON library alone would let pass refused: repeated keys, nesting without bound,
// numbers beyond double precision, files without bound.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace lenses::io {

inline constexpr std::size_t kMaxFileBytes = std::size_t{64} << 20;
inline constexpr int kMaxDepth = 64;  // the deepest format needs 8

// Where a value was read: the file, and in JSON Lines the place inside it ("line 3"), else empty.
struct Source {
  std::string file;
  std::string place;
};

[[nodiscard]] std::string read_text_file(const std::string& path);
[[nodiscard]] nlohmann::json parse_json(std::string_view text, const Source& source);

// A dotted path's next part: `.key`, or the key as a JSON string where it would not read as one word.
[[nodiscard]] std::string join_path(const std::string& path, std::string_view key);
[[nodiscard]] std::string join_path(const std::string& path, std::size_t index);

// The field of an InputError: the place, then the path.
[[nodiscard]] std::string field_name(const Source& source, const std::string& path);

// Text fit for a one-line message: as a JSON string, cut when long.
[[nodiscard]] std::string in_quotes(std::string_view text);

}  // namespace lenses::io
