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
  bool traces;      // takes the variant's constants
  bool wavefronts;  // those about the wavefront among them
};

Recipe recipe_of(Stage stage) {
  switch (stage) {
    case Stage::chief:
      return {"trace", shaders::chief, scene_and(3), true, true};
    case Stage::edges:
      return {"edges", shaders::edges, scene_and(2), true, false};
    case Stage::samples:
      return {"samples", shaders::dof, scene_and(3), true, false};
    case Stage::blur:
      return {"blur", shaders::blur, {Binding::texel_rgba32ui, Binding::storage_buffer}, false, false};
    case Stage::encode:
      break;
  }
  return {"encode", shaders::encode, std::vector<Binding>(3, Binding::storage_buffer), false, false};
}

}  // namespace

const vk::Kernel& KernelSet::get(Stage stage, const TraceVariant& variant) {
  const Recipe recipe = recipe_of(stage);
  // By constant id, then the stage.
  std::array<std::uint32_t, 6> key{0, 0, 0, 0, 0, static_cast<std::uint32_t>(stage)};
  if (recipe.traces) {
    key[0] = variant.surface_kinds;
    key[1] = variant.scene_features;
    key[4] = variant.bare ? 1U : 0U;
  }
  if (recipe.wavefronts) {
    key[2] = variant.wavefront ? 1U : 0U;
    key[3] = variant.keep_wavefront ? 1U : 0U;
  }
  const auto found = kernels_.find(key);
  if (found != kernels_.end()) {
    return found->second;
  }
  const auto constants = std::span<const std::uint32_t>(key).first(recipe.traces ? 5 : 0);
  return kernels_
      .emplace(key, vk::Kernel(device_, recipe.code, recipe.bindings, sizeof(gpu::FrameData), constants, recipe.name))
      .first->second;
}

}  // namespace render
