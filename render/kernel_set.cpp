#include "render/kernel_set.hpp"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "render/frame_types.hpp"
#include "shaders/beam_blocks.hpp"
#include "shaders/beams.hpp"
#include "shaders/between.hpp"
#include "shaders/blur.hpp"
#include "shaders/blur_layers.hpp"
#include "shaders/blur_levels.hpp"
#include "shaders/blur_narrow.hpp"
#include "shaders/blur_reach.hpp"
#include "shaders/blur_squares.hpp"
#include "shaders/blur_tiles.hpp"
#include "shaders/chief.hpp"
#include "shaders/colour.hpp"
#include "shaders/corners.hpp"
#include "shaders/edges.hpp"
#include "shaders/encode.hpp"
#include "shaders/find_edges.hpp"
#include "shaders/find_rough.hpp"
#include "shaders/found.hpp"
#include "shaders/found_cubic.hpp"
#include "shaders/left_out.hpp"
#include "shaders/ray_query.hpp"
#include "shaders/rays.hpp"
#include "shaders/rays_double.hpp"
#include "shaders/samples.hpp"
#include "shaders/tile.hpp"
#include "shaders/tile_cubic.hpp"
#include "shaders/unsettled.hpp"
#include "shaders/unsettled_corners.hpp"

namespace render {
namespace {

using vk::Binding;

// shaders/scene_bindings.glsl, then the stage's own.
std::vector<Binding> scene_and(std::size_t storage_buffers, std::vector<Binding> more = {}) {
  std::vector<Binding> bindings{Binding::texel_rgba32f,  Binding::texel_rgba32ui, Binding::texel_rgba32f,
                                Binding::texel_rgba32f,  Binding::texel_r32ui,    Binding::texel_rgba32ui,
                                Binding::uniform_buffer, Binding::texel_rgba32ui, Binding::texel_rgba32ui,
                                Binding::texel_rgba32ui};
  bindings.insert(bindings.end(), storage_buffers, Binding::storage_buffer);
  bindings.insert(bindings.end(), more.begin(), more.end());
  return bindings;
}

constexpr std::size_t kColumnsAt = 11;  // shaders/columns.glsl

// Which specialisation constants a stage has; the numbers of the first are those of TraceVariant's members.
enum class Constants { none, lanes_and_features, scene, chief, aim, samples, blur };

constexpr std::size_t kListedTilesAt = 10;  // shaders/group.glsl

struct Recipe {
  const char* name;
  std::span<const std::uint32_t> code;
  std::vector<Binding> bindings;
  Constants constants;
};

Recipe recipe_of(Stage stage) {
  using enum Binding;
  switch (stage) {
    case Stage::rays:
      return {"rays", shaders::rays, scene_and(3, {texel_rgba32f, storage_buffer}), Constants::aim};
    case Stage::rays_double:
      return {"rays_double",
              shaders::rays_double,
              {texel_rgba32ui, uniform_buffer, storage_buffer, storage_buffer, storage_buffer, texel_rgba32f},
              Constants::aim};
    case Stage::corners:
      return {"corners", shaders::corners, scene_and(2), Constants::scene};
    case Stage::unsettled_corners:
      return {"unsettled_corners", shaders::unsettled_corners, scene_and(2), Constants::scene};
    case Stage::between:
      return {"between", shaders::between, scene_and(3, {texel_rgba32f, storage_buffer}), Constants::scene};
    case Stage::unsettled:
      return {"unsettled", shaders::unsettled, scene_and(3, {texel_rgba32f, storage_buffer}), Constants::aim};
    case Stage::find_rough:
      return {"find_rough",
              shaders::find_rough,
              {texel_rgba32f, storage_buffer, storage_buffer, storage_buffer},
              Constants::none};
    case Stage::tile:
      return {"tile",
              shaders::tile,
              {texel_rgba32f, texel_rgba32f, texel_rgba32ui, texel_rgba32f, storage_buffer, storage_buffer},
              Constants::lanes_and_features};
    case Stage::tile_cubic:
      return {"tile_cubic",
              shaders::tile_cubic,
              {texel_rgba32f, texel_r32ui, texel_rgba32ui, texel_rgba32f, storage_buffer, storage_buffer,
               texel_rgba32ui, storage_buffer, storage_buffer},
              Constants::lanes_and_features};
    case Stage::ray_query:
      return {"ray_query", shaders::ray_query,
              scene_and(0, {texel_rgba32f, texel_rgba32f, storage_buffer, storage_buffer, acceleration_structure}),
              Constants::scene};
    case Stage::left_out:
      return {"left_out", shaders::left_out,
              scene_and(0, {texel_rgba32f, texel_rgba32f, storage_buffer, storage_buffer}), Constants::scene};
    case Stage::chief:
      return {"trace", shaders::chief, scene_and(3), Constants::chief};
    case Stage::found:
      return {"found", shaders::found, scene_and(3, {texel_r32ui, texel_rgba32f, texel_rgba32f, texel_rgba32f}),
              Constants::chief};
    case Stage::found_cubic:
      return {"found_cubic", shaders::found_cubic, scene_and(3, {texel_r32ui, texel_rgba32f, texel_r32ui}),
              Constants::chief};
    case Stage::beam_blocks:
      return {"beam_blocks", shaders::beam_blocks, scene_and(1, {texel_rgba32ui, texel_rg32ui}), Constants::scene};
    case Stage::find_edges:
      return {"find_edges",
              shaders::find_edges,
              {texel_rgba32ui, texel_rg32ui, texel_r32ui, storage_buffer, storage_buffer},
              Constants::none};
    case Stage::beams:
      return {"beams", shaders::beams, scene_and(3, {texel_rgba32ui}), Constants::scene};
    case Stage::edges:
      return {"edges", shaders::edges, scene_and(3, {texel_rg32ui}), Constants::scene};
    case Stage::samples:
      return {"samples", shaders::samples, scene_and(2, {texel_r32ui, texel_rgba32f, texel_rgba32f}),
              Constants::samples};
    case Stage::blur:
      return {"blur", shaders::blur, {texel_rgba32ui, storage_buffer, texel_rg32ui, texel_r32ui}, Constants::blur};
    case Stage::blur_squares:
      return {"blur_squares",
              shaders::blur_squares,
              {texel_rgba32ui, storage_buffer, texel_rg32ui, texel_r32ui},
              Constants::blur};
    case Stage::blur_tiles:
      return {"blur_tiles",
              shaders::blur_tiles,
              {texel_rgba32ui, storage_buffer, storage_buffer, storage_buffer},
              Constants::blur};
    case Stage::blur_reach:
      return {"blur_reach",
              shaders::blur_reach,
              {texel_rgba32ui, texel_rgba32f, storage_buffer, texel_r32ui, storage_buffer, storage_buffer,
               storage_buffer, storage_buffer, storage_buffer, storage_buffer},
              Constants::blur};
    case Stage::blur_narrow:
      return {"blur_narrow", shaders::blur_narrow, {texel_rgba32ui, storage_buffer, texel_r32ui}, Constants::blur};
    case Stage::blur_levels:
      return {"blur_levels",
              shaders::blur_levels,
              {texel_rgba32ui, storage_buffer, texel_r32ui, texel_r32ui},
              Constants::blur};
    case Stage::blur_layers:
      return {"blur_layers",
              shaders::blur_layers,
              {texel_rgba32ui, storage_buffer, texel_rg32ui, texel_r32ui},
              Constants::blur};
    case Stage::encode:
      return {"encode", shaders::encode, {texel_rg32ui, storage_buffer}, Constants::none};
    case Stage::colour:
      break;
  }
  return {"colour", shaders::colour, {texel_rgba32f, storage_buffer}, Constants::none};
}

}  // namespace

bool goes_by_tiles(Stage stage) {
  switch (stage) {
    case Stage::rays:
    case Stage::rays_double:
    case Stage::between:
    case Stage::find_rough:
    case Stage::tile:
    case Stage::tile_cubic:
    case Stage::ray_query:
    case Stage::chief:
    case Stage::found:
    case Stage::found_cubic:
    case Stage::beam_blocks:
    case Stage::find_edges:
    case Stage::samples:
    case Stage::encode:
    case Stage::colour:
      return true;
    default:
      return false;
  }
}

bool can_trace_tiles(const vk::DeviceLimits& limits) {
  const std::uint32_t size = limits.subgroup_size;
  return limits.has_subgroup_reductions && (size == 8 || size == 16 || size == 32 || size == 64);
}

const vk::Kernel& KernelSet::get(Stage stage, const TraceVariant& variant) {
  const Recipe recipe = recipe_of(stage);
  Key key{};
  std::size_t count = 0;
  if (recipe.constants == Constants::lanes_and_features) {
    key[0] = device_.limits().subgroup_size;
    key[1] = variant.scene_features;
    count = 2;
  } else if (recipe.constants != Constants::none) {
    key[0] = variant.surface_kinds;
    key[1] = variant.scene_features;
    key[4] = variant.bare ? 1U : 0U;
    key[5] = variant.newton_steps;
    const bool passes_rays_on = stage == Stage::rays || stage == Stage::between || stage == Stage::unsettled;
    const bool keeps = variant.keep_transfer && !variant.sampled;
    key[6] = keeps && (passes_rays_on || stage == Stage::found) ? 1U : 0U;
    key[7] = stage == Stage::found && !variant.hits_known ? 1U : 0U;
    key[9] = variant.view_traits;
    key[kColumnsAt] = device_.limits().on_processor ? 1U : 8U;
    count = kColumnsAt + 1;
  }
  if (recipe.constants == Constants::chief) {
    key[2] = variant.wavefront ? 1U : 0U;
    key[3] = variant.keep_wavefront ? 1U : 0U;
  }
  if (recipe.constants == Constants::aim || recipe.constants == Constants::samples) {
    key[8] = (recipe.constants == Constants::aim ? variant.sampled : variant.hits_known) ? 1U : 0U;
  }
  if (recipe.constants == Constants::samples) {
    key[0] = key[5] = key[6] = 0;  // the lens is behind them
  }
  if (variant.listed_tiles && goes_by_tiles(stage)) {
    key[kListedTilesAt] = 1U;
    count = std::max(count, kListedTilesAt + 1);
  }
  return get(stage, key, count);
}

const vk::Kernel& KernelSet::get(Stage stage, const BlurVariant& variant) {
  const Key key{variant.taps, variant.gaussian ? 1U : 0U, variant.encode ? 1U : 0U,
                static_cast<std::uint32_t>(variant.rate), variant.wide ? 1U : 0U};
  return get(stage, key, 5);
}

const vk::Kernel& KernelSet::get(Stage stage, Key key, std::size_t constants) {
  key.back() = static_cast<std::uint32_t>(stage);
  const auto found = kernels_.find(key);
  if (found != kernels_.end()) {
    return found->second;
  }
  Recipe recipe = recipe_of(stage);
  if (goes_by_tiles(stage)) {
    recipe.bindings.push_back(Binding::texel_r32ui);
  }
  return kernels_
      .emplace(key, vk::Kernel(device_, recipe.code, recipe.bindings, sizeof(gpu::FrameData),
                               std::span<const std::uint32_t>(key).first(constants), recipe.name))
      .first->second;
}

}  // namespace render
