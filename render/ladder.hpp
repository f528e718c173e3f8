// The ladder of settings: what --accuracy names, from the coarsest to the finest of each kind.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "render/accuracy.hpp"
#include "render/renderer.hpp"

namespace render {

struct Rung {
  std::string_view name;     // as --accuracy takes it
  std::string_view subject;  // what is varied: "lens iterations", "blur taps", ...
  std::string_view what;     // one line for people
  Accuracy accuracy;
  std::optional<Mode> mode = {};    // where the rung asks for one
  std::optional<int> samples = {};  // dof
};

[[nodiscard]] std::span<const Rung> ladder();

// Null where no rung has the name.
[[nodiscard]] const Rung* find_rung(std::string_view name);

}  // namespace render
