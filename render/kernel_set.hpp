// The frame's kernels, compiled when first asked for and kept: one for each stage and specialisation.
#pragma once

#include <array>
#include <cstdint>
#include <map>

#include "render/vk/device.hpp"
#include "render/vk/kernel.hpp"

namespace render {

enum class Stage : std::uint32_t {
  rays,
  rays_double,
  corners,
  unsettled_corners,
  between,
  unsettled,
  find_rough,
  tile,
  tile_cubic,
  ray_query,
  left_out,
  chief,
  found,
  found_cubic,
  beam_blocks,
  find_edges,
  beams,
  edges,
  samples,
  blur_tiles,
  blur_reach,
  blur_levels,
  blur_squares,
  blur_narrow,
  blur,
  blur_layers,
  encode,
  colour
};

// How the kernels that trace are specialised (shaders/chief.comp.glsl); the others ignore it.
struct TraceVariant {
  std::uint32_t surface_kinds = 0xffffffffU;   // surface_kinds() of gpu_tracer.hpp
  std::uint32_t scene_features = 0xffffffffU;  // SceneBuffers::features
  std::uint32_t view_traits = 0xffffffffU;     // view_traits() of view_setup.hpp
  bool wavefront = true;                       // false: radiance only
  bool keep_wavefront = false;
  bool bare = false;               // one light, no shadow rays
  std::uint32_t newton_steps = 0;  // LensAccuracy::iterations
  bool keep_transfer = false;      // rays leave, and found rays take up, the ray-transfer matrix as well
  bool sampled = false;            // rays are samples of distributed rays
  bool hits_known = false;         // what rays meet is found by a kernel of its own
  bool listed_tiles = false;       // not all tiles are drawn (shown_tiles.hpp)
};

// How the kernels of approximate defocus are specialised (shaders/gather.glsl).
struct BlurVariant {
  std::uint32_t taps = 0;  // about the most of a gathered blur; 0: nothing is blurred
  bool gaussian = false;
  int rate = 1;         // BlurAccuracy::rate
  bool encode = false;  // straight to the display's bytes
  bool wide = false;    // from a picture that wide blurs gather from (shaders/frame.h)
};

// Whether a stage goes through the picture by tiles: its last buffer is ShownTiles's list.
[[nodiscard]] bool goes_by_tiles(Stage stage);

// Whether this device can run Stage::tile: a subgroup of 8 to 64 that reduces, votes and shuffles.
[[nodiscard]] bool can_trace_tiles(const vk::DeviceLimits& limits);

class KernelSet {
 public:
  explicit KernelSet(vk::Device& device) : device_(device) {}

  [[nodiscard]] const vk::Kernel& get(Stage stage, const TraceVariant& variant = {});
  [[nodiscard]] const vk::Kernel& get(Stage stage, const BlurVariant& variant);
  [[nodiscard]] std::size_t size() const { return kernels_.size(); }

 private:
  using Key = std::array<std::uint32_t, 13>;  // the constants by id, at the end the stage

  const vk::Kernel& get(Stage stage, Key key, std::size_t constants);

  vk::Device& device_;
  std::map<Key, vk::Kernel> kernels_;
};

}  // namespace render
