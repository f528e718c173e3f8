#include "render/kernel_set.hpp"

#include <span>
#include <vector>

#include "render/frame_types.hpp"
#include "shaders/blur.hpp"
#include "shaders/chief.hpp"
#include "shaders/dof.hpp"
#include "shaders/edges.hpp"
#include "shaders/encode.hpp"

namespace render {
namespace {

using vk::Binding;

// shaders/scene_bindings.glsl, then the stage's own storage buffers.
std::vector<Binding> scene_and(std::size_t own) {
  std::vector<Binding> bindings{Binding::texel_rgba32f,  Binding::texel_rgba32ui, Binding::texel_rgba32f,
                                Binding::texel_rgba32f,  Binding::texel_r32ui,    Binding::uniform_buffer,
                                Binding::uniform_buffer, Binding::storage_buffer, Binding::storage_buffer,
                                Binding::storage_buffer};
  bindings.insert(bindings.end(), own, Binding::storage_buffer);
  return bindings;
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
      return {"trace", shaders::chief, scene_and(3), 4};
    case Stage::edges:
      return {"edges", shaders::edges, scene_and(2), 2};
    case Stage::samples:
      return {"samples", shaders::dof, scene_and(3), 2};
    case Stage::blur:
      return {"blur", shaders::blur, {Binding::texel_rgba32ui, Binding::storage_buffer}, 0};
    case Stage::encode:
      break;
  }
  return {"encode", shaders::encode, std::vector<Binding>(3, Binding::storage_buffer), 0};
}

}  // namespace

const vk::Kernel& KernelSet::get(Stage stage, const TraceVariant& variant) {
  const Recipe recipe = recipe_of(stage);
  std::array<std::uint32_t, 5> key{variant.surface_kinds, variant.scene_features, variant.wavefront ? 1U : 0U,
                                   variant.keep_wavefront ? 1U : 0U, static_cast<std::uint32_t>(stage)};
  for (std::size_t i = recipe.constants; i + 1 < key.size(); ++i) {
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
