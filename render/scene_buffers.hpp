// A scene on the device: the buffers that the tracing kernels bind, in the order of shaders/scene_bindings.glsl.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "render/scene/bvh.hpp"
#include "render/scene/scene.hpp"
#include "render/vk/acceleration.hpp"
#include "render/vk/buffer.hpp"
#include "render/vk/device.hpp"

namespace render {

struct SceneBuffers {
  // Uploads once; the scene may go. A scene beyond the device's buffers throws vk::DeviceError with the numbers.
  SceneBuffers(vk::Device& device, const Scene& scene);

  vk::Buffer bvh_nodes, wide_nodes, bvh_triangles, shading_triangles, texels, environment, lights, materials, textures;
  std::size_t triangle_count = 0;
  std::uint32_t features = 0;  // kFeature... of shaders/view.h: what kernels must know for this scene

  // For Stage::ray_query; built when first asked for, kept until dropped.
  [[nodiscard]] const vk::Acceleration& acceleration(const vk::Device& device) const;
  void drop_acceleration() const { acceleration_.reset(); }

 private:
  struct Parts;
  SceneBuffers(vk::Device& device, const Scene& scene, Parts&& parts);

  mutable std::optional<vk::Acceleration> acceleration_;
};

// Uploads values; an empty list becomes one zeroed element, because a shader's buffer may not be empty.
template <class T>
[[nodiscard]] vk::Buffer filled_buffer(vk::Device& device, std::vector<T> values) {
  if (values.empty()) {
    values.push_back(T{});
  }
  vk::Buffer buffer(device, values.size() * sizeof(T), vk::Memory::device);
  buffer.write(values);
  return buffer;
}

}  // namespace render
