// --mode: what a picture shows.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "render/renderer.hpp"

namespace app {

// In the order of render::Mode.
[[nodiscard]] inline const std::vector<std::string>& mode_names() {
  static const std::vector<std::string> names{"pinhole",     "adof",          "dof", "power",
                                              "astigmatism", "accommodation", "blur"};
  return names;
}

[[nodiscard]] inline render::Mode mode_of(const std::string& name) {
  return static_cast<render::Mode>(std::ranges::find(mode_names(), name) - mode_names().begin());
}

}  // namespace app
