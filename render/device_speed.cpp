#include "render/device_speed.hpp"

#include <algorithm>
#include <array>

#include "render/vk/buffer.hpp"
#include "render/vk/commands.hpp"
#include "render/vk/kernel.hpp"
#include "shaders/multiply_add.hpp"

namespace render {
namespace {

constexpr int kRuns = 5;

// Milliseconds of the fastest run; the first one, which compiles, does not count.
template <class Record>
double fastest(vk::Device& device, const Record& record) {
  double best = 0.0;
  for (int i = 0; i <= kRuns; ++i) {
    vk::Commands commands(device);
    commands.timestamp("start");
    record(commands);
    commands.timestamp("work");
    const auto times = device.run(commands);
    if (times.size() < 2) return 0.0;
    if (i == 1 || (i > 1 && times[1].milliseconds < best)) best = times[1].milliseconds;
  }
  return best;
}

double gflops(vk::Device& device) {
  // As shaders/multiply_add.comp.glsl: 16 floats a lane, two operations each, kSteps times.
  constexpr std::uint32_t kGroup = 64, kGroups = 16384, kSteps = 64, kOperations = 2 * 16;
  const std::array bindings{vk::Binding::storage_buffer};
  const vk::Kernel kernel(device, shaders::multiply_add, bindings, sizeof(std::uint32_t), {}, "multiply_add");
  const vk::Buffer out(device, std::size_t{kGroup} * kGroups * sizeof(float), vk::Memory::device);
  const double ms = fastest(
      device, [&](vk::Commands& commands) { commands.dispatch(kernel, {&out}, vk::bytes_of(kSteps), kGroups); });
  return ms > 0.0 ? static_cast<double>(kGroup) * kGroups * kSteps * kOperations / ms * 1e-6 : 0.0;
}

double gigabytes_per_s(vk::Device& device) {
  const std::size_t bytes = std::min<std::size_t>(device.limits().max_storage_buffer_bytes, std::size_t{64} << 20U);
  vk::Buffer from(device, bytes, vk::Memory::device);
  vk::Buffer to(device, bytes, vk::Memory::device);
  {
    vk::Commands commands(device);
    commands.fill_zero(from);  // memory that was never written may be one page many times
    device.run(commands);
  }
  const double ms = fastest(device, [&](vk::Commands& commands) { commands.copy(from, to, bytes); });
  return ms > 0.0 ? 2.0 * static_cast<double>(bytes) / ms * 1e-6 : 0.0;
}

}  // namespace

DeviceSpeed measure_speed(vk::Device& device) {
  return {gflops(device), gigabytes_per_s(device)};
}

}  // namespace render
