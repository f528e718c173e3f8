// The directions that a picture's points stand for, in double precision on the CPU.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "render/view_setup.hpp"

namespace render {

// From the pupil, primary axes, unit. at: parts of the picture from its upper left corner, right and down.
[[nodiscard]] glm::dvec3 view_direction(const ViewSetup& view, const glm::dvec2& at);

}  // namespace render
