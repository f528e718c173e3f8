#include "render/kernel_set.hpp"

#include <span>
#include <vector>

#include "render/frame_types.hpp"
#include "shaders/blur.hpp"
#include "shaders/chief.hpp"
#include "shaders/dof.hpp"
#include "shaders/edges.hpp"
#include "shaders/encode.hpp"
#include "shaders/find_edges.hpp"
#include "shaders/left_out.hpp"
#include "shaders/rays.hpp"
#include "shaders/tile.hpp"

namespace render {
namespace {

using vk::Binding;

// shaders/scene_bindings.glsl, then the stage's own storage buffers.
std::vector<Binding> scene_and(std::size_t own) {
  std::vector<Binding> bindings{Binding::texel_rgba32f,  Binding::texel_rgba32ui, Binding::texel_rgba32f,
                                Binding::texel_rgba32f,  Binding::texel_r32ui,    Binding::uniform_buffer,
                                Binding::uniform_buffer, Binding::texel_rgba32ui, Binding::texel_rgba32ui,
                                Binding::texel_rgba32ui};
  bindings.insert(bindings.end(), own, Binding::storage_buffer);
  return bindings;
}

std::vector<Binding> chief_bindings() {
  std::vector<Binding> bindings = scene_and(3);
  bindings.push_back(Binding::texel_r32ui);
  return bindings;
}

std::vector<Binding> tile_bindings() {
  return {Binding::texel_rgba32f, Binding::texel_rgba32f,  Binding::texel_rgba32ui,
          Binding::texel_rgba32f, Binding::storage_buffer, Binding::storage_buffer};
}

std::vector<Binding> find_edges_bindings() {
  return {Binding::texel_rgba32ui, Binding::texel_r32ui, Binding::storage_buffer};
}

struct Recipe {
  const char* name;
  std::span<const std::uint32_t> code;
  std::vector<Binding> bindings;
  std::size_t constants;  // how many of the variant's it takes
};

Recipe recipe_of(Stage stage) {
  switch (stage) {
    case Stage::chief:
      return {"trace", shaders::chief, chief_bindings(), 5};
    case Stage::edges:
      return {"edges", shaders::edges, scene_and(2), 2};
    case Stage::samples:
      return {"samples", shaders::dof, scene_and(3), 2};
    case Stage::blur:
      return {"blur", shaders::blur, {Binding::texel_rgba32ui, Binding::storage_buffer}, 0};
    case Stage::rays:
      return {"rays", shaders::rays, scene_and(2), 2};
    case Stage::tile:
      return {"tile", shaders::tile, tile_bindings(), 1};
    case Stage::left_out:
      return {"left_out", shaders::left_out, tile_bindings(), 0};
    case Stage::find_edges:
      return {"find_edges", shaders::find_edges, find_edges_bindings(), 0};
    case Stage::encode:
      break;
  }
  return {"encode", shaders::encode, std::vector<Binding>(3, Binding::storage_buffer), 0};
}

}  // namespace

bool can_trace_tiles(const vk::DeviceLimits& limits) {
  const std::uint32_t size = limits.subgroup_size;
  return limits.has_subgroup_reductions && (size == 8 || size == 16 || size == 32 || size == 64);
}

const vk::Kernel& KernelSet::get(Stage stage, const TraceVariant& variant) {
  const Recipe recipe = recipe_of(stage);
  std::array<std::uint32_t, 6> key{variant.surface_kinds,       variant.shadows ? 1U : 0U,
                                   variant.wavefront ? 1U : 0U, variant.keep_wavefront ? 1U : 0U,
                                   variant.tile ? 1U : 0U,      static_cast<std::uint32_t>(stage)};
  if (stage == Stage::tile) {
    key[0] = device_.limits().subgroup_size;
  }
  for (std::size_t i = recipe.constants; i < 5; ++i) {
    key[i] = 0;
  }
  const auto found = kernels_.find(key);
  if (found != kernels_.end()) {
    return found->second;
  }
  const auto constants = std::span<const std::uint32_t>(key).first(recipe.constants);
  return kernels_
      .emplace(key, vk::Kernel(device_, recipe.code, recipe.bindings, sizeof(gpu::FrameData), constants, recipe.name))
      .first->second;
}

}  // namespace render
