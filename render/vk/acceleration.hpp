// Triangles made ready for ray queries (VK_KHR_acceleration_structure): a bottom level that holds them, and a top level
// of one instance of it as it stands.
#pragma once

#include <cstddef>
#include <vector>

#include "render/vk/buffer.hpp"

namespace render::vk {

struct Acceleration {
  Buffer top;             // to be bound as Binding::acceleration_structure; keeps the bottom level alive
  std::size_t bytes = 0;  // device memory of both levels
};

// Nine numbers a triangle, its corners' x, y, z; its primitive index is its place. Opaque where the ray says so.
// While it builds, the corners and the driver's scratch stand beside it. Needs DeviceLimits::has_ray_query, else
// std::invalid_argument; more triangles than the device takes or has memory for: DeviceError.
[[nodiscard]] Acceleration build_acceleration(const Device& device, const std::vector<float>& corners);

}  // namespace render::vk
