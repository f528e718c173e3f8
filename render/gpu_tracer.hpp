// The GPU engine of the `trace` command: batches of rays through lenses with the functions that the render kernels use.
#pragma once

#include <vector>

#include "lenses/trace.hpp"
#include "render/vk/device.hpp"

namespace render {

// One record a ray, in order; batches beyond the device's buffers are split. Throws vk::DeviceError.
[[nodiscard]] std::vector<lenses::f32::TraceOutput> trace_on_gpu(vk::Device& device, const lenses::TraceBatch& batch);

// Bit k is set if some lens has a back surface of kind k, bit 16 + k a front: the specialisation constant
// kSurfaceKinds.
[[nodiscard]] std::uint32_t surface_kinds(const std::vector<lenses::f64::LensData>& lenses);

}  // namespace render
