// Text in the fixed arrays of OpenXR's structures, cut to fit.
#pragma once

#include <algorithm>
#include <cstring>
#include <string>

namespace xr {

template <std::size_t N>
void copy_text(char (&to)[N], const std::string& from) {
  const std::size_t length = std::min(from.size(), N - 1);
  std::memcpy(to, from.data(), length);
  to[length] = '\0';
}

}  // namespace xr
