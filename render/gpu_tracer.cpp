#include "render/gpu_tracer.hpp"

#include <algorithm>
#include <array>

#include "render/scene_buffers.hpp"
#include "render/vk/buffer.hpp"
#include "render/vk/commands.hpp"
#include "render/vk/kernel.hpp"
#include "shaders/trace.hpp"

namespace render {
namespace {

constexpr std::uint32_t kGroup = 64;       // local size of trace.comp.glsl
constexpr std::size_t kChunk = 1U << 18U;  // rays a submission: 32 MiB of records

template <class To, class From>
std::vector<To> rounded(const std::vector<From>& values) {
  std::vector<To> out;
  out.reserve(values.size());
  std::ranges::transform(values, std::back_inserter(out), [](const From& v) { return lenses::to_float(v); });
  return out;
}

}  // namespace

std::uint32_t surface_kinds(const std::vector<lenses::f64::LensData>& lenses) {
  std::uint32_t kinds = 0U;
  for (const auto& lens : lenses) {
    if (lens.glass.w == 0.0) {
      continue;
    }
    kinds |= static_cast<std::uint32_t>(lens.back.parts.w);
    kinds |= static_cast<std::uint32_t>(lens.front.parts.w) << 16U;
    kinds |= lens.mount.y != 0 ? 1U << 31U : 0U;
  }
  return kinds;
}

std::vector<lenses::f32::TraceOutput> GpuTracer::trace(const lenses::TraceBatch& batch, int newton_steps) {
  using lenses::f32::TraceInput;
  using lenses::f32::TraceOutput;
  std::vector<TraceOutput> results;
  if (batch.rays.empty()) {
    return results;
  }
  const std::array constants{surface_kinds(batch.model.lens), static_cast<std::uint32_t>(newton_steps)};
  auto found = kernels_.find(constants);
  if (found == kernels_.end()) {
    const std::array bindings{vk::Binding::texel_rgba32f, vk::Binding::storage_buffer, vk::Binding::storage_buffer,
                              vk::Binding::storage_buffer, vk::Binding::storage_buffer};
    found = kernels_
                .emplace(constants,
                         vk::Kernel(device_, shaders::trace, bindings, sizeof(std::uint32_t), constants, "trace"))
                .first;
  }
  const std::vector<glm::vec4> entries = lenses::to_float(batch.model.table);
  const vk::Buffer table = filled_buffer(device_, entries);
  const vk::Buffer lens_buffer = filled_buffer(device_, rounded<lenses::f32::LensData>(batch.model.lens));
  const vk::Buffer eye_buffer = filled_buffer(device_, rounded<lenses::f32::EyeData>(batch.eyes));
  results.reserve(batch.rays.size());
  for (std::size_t first = 0; first < batch.rays.size(); first += kChunk) {
    const std::size_t count = std::min(kChunk, batch.rays.size() - first);
    std::vector<TraceInput> rays;
    rays.reserve(count);
    for (std::size_t i = first; i < first + count; ++i) {
      const auto& ray = batch.rays[i];
      rays.push_back({glm::vec4(ray.direction), glm::vec4(ray.gaze), ray.which});
    }
    const vk::Buffer input = filled_buffer(device_, rays);
    const vk::Buffer output(device_, count * sizeof(TraceOutput), vk::Memory::readback);
    vk::Commands commands(device_);
    const auto ray_count = static_cast<std::uint32_t>(count);
    commands.dispatch(found->second, {&table, &lens_buffer, &eye_buffer, &input, &output}, vk::bytes_of(ray_count),
                      (ray_count + kGroup - 1) / kGroup);
    device_.run(commands);
    std::ranges::copy(output.read<TraceOutput>(count), std::back_inserter(results));
  }
  return results;
}

}  // namespace render
