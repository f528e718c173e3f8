// The compute device: a Vulkan instance, one physical device, one queue with compute, and what came of checking them.
// Nothing of Vulkan is visible here. One thread at a time may use a Device and what was made from it; several Devices
// may live side by side. Buffers, kernels and commands keep what they need of their device alive.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace render::vk {

class Commands;
struct DeviceState;
struct DeviceMaker;
struct WindowBinding;

// No Vulkan loader or driver, no such device, a size beyond the device's limits, out of memory, device lost.
class DeviceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct DeviceConfig {
  // Empty: the first discrete GPU, else the first integrated one, else any. A number: that index in device_names().
  // Anything else: the first device with this in its name, whatever the case.
  std::string device = {};
  // Validation with synchronisation checks; its warnings and errors gather in Device::validation_messages().
  bool validation = false;
  // Compiled pipelines are read from this file at start and written by save_pipeline_cache(); empty: none.
  std::filesystem::path pipeline_cache = {};
  // False: Memory::device is never mapped, as on a GPU whose bus shows the host none of it; everything is staged.
  bool map_device_memory = true;
  // Makes the device in our place (external.hpp) and picks it; `device` is then only checked. Used while opening.
  const DeviceMaker* maker = nullptr;
  // A window to show pictures in (external.hpp), not together with a maker: only a device that can is opened. Used
  // while opening.
  const WindowBinding* window = nullptr;
};

struct DeviceLimits {
  std::size_t max_storage_buffer_bytes = 0;  // also the largest Buffer
  std::size_t max_texel_elements = 0;        // elements of one texel buffer
  std::size_t max_uniform_buffer_bytes = 0;
  std::size_t max_push_constant_bytes = 0;
  std::uint32_t max_groups[3] = {0, 0, 0};  // of one dispatch
  std::uint32_t max_workgroup_invocations = 0;
  std::uint32_t subgroup_size = 0;
  bool has_subgroup_reductions = false;  // and ballots, broadcasts and shuffles, in compute shaders
  std::size_t shared_bytes = 0;          // shared memory of a workgroup
  double timestamp_period_ns = 0.0;      // 0: the queue has no timestamps
  bool has_float64 = false;
  bool on_processor = false;   // the driver computes on the CPU
  bool has_ray_query = false;  // VK_KHR_ray_query, and what its acceleration structures need
};

struct StageTime {
  std::string name;
  double milliseconds;
};

class Device {
 public:
  explicit Device(const DeviceConfig& config = {});
  ~Device();
  Device(Device&&) noexcept;
  Device& operator=(Device&&) noexcept;
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  // Every device with Vulkan 1.2 and a compute queue, in the order that DeviceConfig::device counts.
  [[nodiscard]] static std::vector<std::string> device_names();

  [[nodiscard]] const std::string& name() const;
  [[nodiscard]] const DeviceLimits& limits() const;

  // Every warning and error of validation so far, oldest first.
  [[nodiscard]] std::vector<std::string> validation_messages() const;

  // Writes the compiled pipelines to DeviceConfig::pipeline_cache, all or nothing; without one it does nothing.
  void save_pipeline_cache() const;

  // Submits once and waits until all of it is done. The times are those of Commands::timestamp, in order; a device
  // without timestamps gives none.
  std::vector<StageTime> run(Commands& commands);

  // For the other files of this folder.
  [[nodiscard]] const std::shared_ptr<DeviceState>& state() const { return state_; }

 private:
  std::shared_ptr<DeviceState> state_;
};

}  // namespace render::vk
