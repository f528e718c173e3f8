// What a designed progressive lens does, in words and as JSON.
#pragma once

#include <string>

#include "lenses/design/progressive_lens.hpp"

namespace app {

struct ProgressiveRun {
  std::string output;  // the lens file
  lenses::ProgressiveLensRequest request;
  lenses::ProgressiveLens made;
  double seconds = 0.0;  // of the design
};

[[nodiscard]] std::string progressive_table(const ProgressiveRun& run);
[[nodiscard]] std::string progressive_json(const ProgressiveRun& run);

}  // namespace app
