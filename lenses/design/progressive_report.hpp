// What a progressive surface does: zones, corridor, peaks.
#pragma once

#include "lenses/design/progressive.hpp"

namespace lenses {

// The surface is in the configuration's axes; it need not be one of design_progressive's.
[[nodiscard]] ProgressiveReport report_progressive(const BsplineHeightField& surface, const ProgressiveConfig& config);

}  // namespace lenses
