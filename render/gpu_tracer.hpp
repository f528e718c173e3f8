// The GPU engine of the `trace` command: batches of rays through lenses with the functions that the render kernels use.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "lenses/trace.hpp"
#include "render/vk/device.hpp"
#include "render/vk/kernel.hpp"

namespace render {

class GpuTracer {
 public:
  explicit GpuTracer(vk::Device& device) : device_(device) {}

  // One record a ray, in order; batches beyond the device's buffers are split. Throws vk::DeviceError. The kernel for a
  // set of surface kinds is compiled when first needed. newton_steps: LensAccuracy::iterations.
  [[nodiscard]] std::vector<lenses::f32::TraceOutput> trace(const lenses::TraceBatch& batch, int newton_steps = 0);

 private:
  vk::Device& device_;
  std::map<std::array<std::uint32_t, 2>, vk::Kernel> kernels_;  // by surface kinds and steps
};

// What the lens code must be compiled for, the specialisation constant kSurfaceKinds: bit k if some lens has a back of
// kind k (surface.h), bit 16 + k a front, bit 31 if the surfaces of some lens may cross.
[[nodiscard]] std::uint32_t surface_kinds(const std::vector<lenses::f64::LensData>& lenses);

}  // namespace render
