// A traversal's kernels alone, on rays that the caller gives.
#pragma once

#include <glm/gtc/type_precision.hpp>
#include <numeric>
#include <vector>

#include "render/frame_buffers.hpp"
#include "render/frame_types.hpp"
#include "render/kernel_set.hpp"
#include "render/scene/gpu/bvh_layout.h"
#include "render/scene/packet_tracer.hpp"
#include "render/scene_buffers.hpp"
#include "render/vk/commands.hpp"

namespace support {

struct DeviceHits {
  std::vector<std::uint32_t> triangle;  // index into Scene::triangles; ~0 for a miss
  std::size_t left_out = 0;             // rays that the traversal handed on
};

// rays: width * height, row by row, direction zero where there is none.
inline DeviceHits device_hits(render::vk::Device& device, const render::SceneBuffers& scene,
                              const std::vector<render::SceneRay>& rays, int width, int height,
                              render::Traversal traversal) {
  namespace gpu = render::gpu;
  const std::size_t count = rays.size();
  render::FrameBuffers buffers(device, {.pixels = count, .hits = true});
  std::vector<glm::vec4> origins, directions;
  for (const render::SceneRay& ray : rays) {
    const bool none = ray.direction == glm::vec3(0.0F);
    origins.emplace_back(ray.origin, 0.0F);
    directions.emplace_back(none ? glm::vec3(0.0F, 0.0F, 1.0F) : ray.direction, none ? -1.0F : 0.0F);
  }
  buffers.ray_origins.write(origins);
  buffers.ray_directions.write(directions);
  std::vector<std::uint32_t> list(count + gpu::kListFirstAt);
  list[1] = list[2] = 1;
  if (traversal == render::Traversal::per_ray) {
    std::iota(list.begin() + gpu::kListFirstAt, list.end(), 0U);
    list[0] = static_cast<std::uint32_t>((count + gpu::kListGroup - 1) / gpu::kListGroup);
    list[gpu::kListCountAt] = static_cast<std::uint32_t>(count);
  }
  buffers.list.write(list);
  gpu::FrameData frame{};
  frame.size = glm::ivec4(width, height, 1, 0);
  const render::vk::Buffer table = render::filled_buffer(device, std::vector<glm::vec4>{});
  const render::vk::Buffer views =
      render::filled_buffer(device, std::vector<gpu::ViewData>(static_cast<std::size_t>(gpu::kMostViews)));
  render::TraceVariant variant;
  variant.surface_kinds = 0;
  variant.scene_features = scene.features;
  render::KernelSet kernels(device);
  render::vk::Commands commands(device);
  if (traversal == render::Traversal::tile) {
    commands.dispatch(kernels.get(render::Stage::tile, variant),
                      {&buffers.ray_origins, &buffers.ray_directions, &scene.wide_nodes, &scene.bvh_triangles,
                       &buffers.hits, &buffers.list, &buffers.shown_tiles},
                      render::vk::bytes_of(frame), static_cast<std::uint32_t>(width + 7) / 8,
                      static_cast<std::uint32_t>(height + 7) / 8);
    commands.barrier();
  }
  const std::vector<const render::vk::Buffer*> all{
      &table,           &scene.bvh_nodes, &scene.bvh_triangles, &scene.shading_triangles,
      &scene.texels,    &views,           &scene.environment,   &scene.lights,
      &scene.materials, &scene.textures,  &buffers.ray_origins, &buffers.ray_directions,
      &buffers.hits,    &buffers.list};
  if (traversal == render::Traversal::ray_query) {
    std::vector<const render::vk::Buffer*> and_structure = all;
    and_structure.push_back(&scene.acceleration(device).top);
    and_structure.push_back(&buffers.shown_tiles);
    commands.dispatch(kernels.get(render::Stage::ray_query, variant), and_structure, render::vk::bytes_of(frame),
                      static_cast<std::uint32_t>(width + 7) / 8, static_cast<std::uint32_t>(height + 7) / 8);
    commands.barrier();
  }
  commands.dispatch_indirect(kernels.get(render::Stage::left_out, variant), all, render::vk::bytes_of(frame),
                             buffers.list);
  device.run(commands);
  DeviceHits hits;
  hits.triangle = buffers.hits.read<std::uint32_t>(count);
  hits.left_out = buffers.list.read<std::uint32_t>(4)[gpu::kListCountAt];
  const auto triangles = scene.bvh_triangles.read<glm::vec4>(scene.bvh_triangles.bytes() / sizeof(glm::vec4));
  for (std::size_t i = 0; i < count; ++i) {
    if (directions[i].w < 0.0F) {
      hits.triangle[i] = ~0U;
    } else if (hits.triangle[i] != ~0U) {
      hits.triangle[i] = glm::floatBitsToUint(triangles.at(hits.triangle[i] * render::kBvhTriangleTexels + 1).w);
    }
  }
  return hits;
}

}  // namespace support
