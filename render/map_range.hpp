// Wavefront maps: what a mode shows of a wavefront, and the range its colours span.
#pragma once

#include <glm/vec4.hpp>
#include <vector>

#include "render/renderer.hpp"

namespace render {

// Dioptres as they are, blur from radians to minutes of arc.
[[nodiscard]] double map_unit_factor(Mode mode);

// From the 1st to the 99th percentile of what a frame shows, outwards to a quarter; `wavefronts` as the device keeps
// them (shaders/frame.h).
[[nodiscard]] MapRange map_range_of(Mode mode, const std::vector<glm::vec4>& wavefronts);

}  // namespace render
