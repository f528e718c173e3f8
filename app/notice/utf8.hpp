// UTF-8 taken apart, for drawing: nothing in a name can break it.
#pragma once

#include <string>
#include <string_view>

namespace app {

// Each byte that belongs to no character (RFC 3629) becomes U+FFFD; control characters and line ends become spaces.
[[nodiscard]] std::u32string drawn_characters(std::string_view utf8);

// Of a code point that is one; anything else is U+FFFD.
[[nodiscard]] std::string to_utf8(std::u32string_view characters);

}  // namespace app
