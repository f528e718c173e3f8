// The rays that a view sends into the scene, traced on the CPU: what the GPU's trace stage traces, for measuring others
// with the same rays.
#pragma once

#include <vector>

#include "lenses/lens_model.hpp"
#include "render/scene/packet_tracer.hpp"
#include "render/view_setup.hpp"

namespace render {

// One a pixel through its centre, tile by tile of 4x4 pixels so that 16 neighbours of the list are neighbours in the
// picture. Rays that end at the lens's rim are left out. Desktop views only: a virtual image is not considered.
[[nodiscard]] std::vector<SceneRay> chief_rays(const ViewSetup& view, const lenses::LensModel& lenses, int width,
                                               int height);

}  // namespace render
