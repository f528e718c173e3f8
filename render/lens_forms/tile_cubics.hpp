// Where a picture's lens rays may be cubics between some of a tile's (shaders/tile_cubics.glsl).
#pragma once

#include <cstdint>
#include <vector>

#include "render/frame_types.hpp"
#include "render/renderer.hpp"
#include "render/vk/device.hpp"

namespace render {

// Whether frames of these settings ask for cubic tiles, and have tiles small enough for most to be smooth. traversal:
// not automatic.
[[nodiscard]] bool may_be_cubic(const FrameConfig& config, const std::vector<ViewSetup>& views, Traversal traversal);

// Whether this device draws tiles of these lenses so. A surface with a segment has corners in its outline, and surfaces
// that may cross leave islands: either may lie between the rays of a tile and be missed. On a device whose subgroups
// are not those of a processor, each pixel's own ray is cheap.
[[nodiscard]] bool can_be_cubic(const vk::DeviceLimits& limits, std::uint32_t surface_kinds);

}  // namespace render
