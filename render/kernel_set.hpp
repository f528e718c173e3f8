// The frame's kernels, compiled when first asked for and kept: one for each stage and specialisation.
#pragma once

#include <array>
#include <cstdint>
#include <map>

#include "render/vk/device.hpp"
#include "render/vk/kernel.hpp"

namespace render {

enum class Stage : std::uint32_t { rays, tile, left_out, chief, find_edges, edges, samples, blur, encode };

// How the kernels that trace are specialised (shaders/chief.comp.glsl); the others ignore it.
struct TraceVariant {
  std::uint32_t surface_kinds = 0xffffffffU;  // see surface_kinds() in gpu_tracer.hpp
  bool shadows = true;                        // false: lights reach everywhere
  bool wavefront = true;                      // false: radiance only
  bool keep_wavefront = false;
  bool tile = false;  // chief rays' hits were found by Stage::tile
};

// Whether this device can run Stage::tile: a subgroup of 8 to 64 that reduces, votes and shuffles.
[[nodiscard]] bool can_trace_tiles(const vk::DeviceLimits& limits);

class KernelSet {
 public:
  explicit KernelSet(vk::Device& device) : device_(device) {}

  [[nodiscard]] const vk::Kernel& get(Stage stage, const TraceVariant& variant = {});

 private:
  vk::Device& device_;
  std::map<std::array<std::uint32_t, 6>, vk::Kernel> kernels_;
};

}  // namespace render
