// What shaders/rays_double.comp.glsl reads of the views.
#pragma once

#include <glm/vec4.hpp>
#include <vector>

#include "lenses/lens_model.hpp"
#include "render/view_setup.hpp"

namespace render {

// As shaders/double_view.h lays them down, as many as a uniform buffer of the shader has.
[[nodiscard]] std::vector<glm::dvec4> double_views(const std::vector<ViewSetup>& views,
                                                   const lenses::LensModel& lenses);

}  // namespace render
