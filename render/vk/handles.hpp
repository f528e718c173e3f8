// What the handles of this folder hold. Private to it: the only header that shows Vulkan. Inside namespace render::vk
// the name vk is this folder's, so Vulkan's own is spelled ::vk.
#pragma once

#include <mutex>
#include <string>
#include <utility>
#include <vector>
#include <vulkan/vulkan_raii.hpp>

#include "render/vk/buffer.hpp"
#include "render/vk/commands.hpp"
#include "render/vk/device.hpp"
#include "render/vk/kernel.hpp"

namespace render::vk {

namespace raii = ::vk::raii;

// Calls something of Vulkan and turns its exceptions into DeviceError; what names the attempt ("allocating 4 bytes").
template <class F>
decltype(auto) guarded(const std::string& what, F&& call) {
  try {
    return std::forward<F>(call)();
  } catch (const ::vk::OutOfDeviceMemoryError&) {
    throw DeviceError(what + ": the device is out of memory");
  } catch (const ::vk::OutOfHostMemoryError&) {
    throw DeviceError(what + ": out of memory");
  } catch (const ::vk::DeviceLostError&) {
    throw DeviceError(what + ": the device was lost");
  } catch (const ::vk::SystemError& error) {
    throw DeviceError(what + ": " + error.what());
  }
}

class MessageLog {
 public:
  void add(std::string message) {
    const std::lock_guard lock(mutex_);
    messages_.push_back(std::move(message));
  }
  [[nodiscard]] std::vector<std::string> messages() const {
    const std::lock_guard lock(mutex_);
    return messages_;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<std::string> messages_;
};

// Loader, instance and, with validation, the messenger that fills the log.
struct Instance {
  explicit Instance(bool validation, const DeviceMaker* maker = nullptr,
                    const std::vector<std::string>& extensions = {});

  MessageLog log;  // before the instance: the messenger writes to it until the instance is gone
  raii::Context context;
  raii::Instance instance = nullptr;
  raii::DebugUtilsMessengerEXT messenger = nullptr;
};

// The devices that this layer can use: Vulkan 1.2 and a queue with compute.
[[nodiscard]] std::vector<raii::PhysicalDevice> usable_devices(const Instance& instance);
[[nodiscard]] std::uint32_t compute_queue_family(const raii::PhysicalDevice& device);
// The first of its families that has all of `flags`; VK_QUEUE_FAMILY_IGNORED without one.
[[nodiscard]] std::uint32_t queue_family_with(const raii::PhysicalDevice& device, ::vk::QueueFlags flags);
// The first of its families that computes, draws and shows pictures on the surface; VK_QUEUE_FAMILY_IGNORED without
// one, or without VK_KHR_swapchain.
[[nodiscard]] std::uint32_t showing_queue_family(const raii::PhysicalDevice& device, const raii::SurfaceKHR& surface);
// As DeviceConfig::device says; throws DeviceError with the names of those present.
[[nodiscard]] raii::PhysicalDevice pick_device(const std::vector<raii::PhysicalDevice>& devices,
                                               const std::string& wanted);
// The one that its maker says; throws DeviceError where that is not `wanted` or lacks what this layer needs.
[[nodiscard]] raii::PhysicalDevice given_device(const Instance& instance, const DeviceMaker& maker,
                                                const std::string& wanted);

// The same for one that shows pictures on the surface; without a wish only such are considered.
[[nodiscard]] raii::PhysicalDevice pick_showing_device(const std::vector<raii::PhysicalDevice>& devices,
                                                       const std::string& wanted, const raii::SurfaceKHR& surface);

struct DeviceState {
  explicit DeviceState(const DeviceConfig& config);

  DeviceConfig config;
  Instance instance;
  raii::SurfaceKHR surface = nullptr;  // of the window that pictures are shown in, where there is one
  raii::PhysicalDevice physical = nullptr;
  std::string name;
  DeviceLimits limits;
  std::uint64_t timestamp_mask = 0;
  std::uint32_t queue_family = 0;
  raii::Device device = nullptr;
  raii::Queue queue = nullptr;
  raii::CommandPool pool = nullptr;
  raii::PipelineCache cache = nullptr;

  // Gives the object a name in validation messages.
  template <class Handle>
  void label(const Handle& handle, const std::string& text) const {
    if (!config.validation || text.empty()) return;
    const auto bits = reinterpret_cast<std::uint64_t>(static_cast<typename Handle::CType>(*handle));
    device.setDebugUtilsObjectNameEXT({Handle::objectType, bits, text.c_str()});
  }

  [[nodiscard]] raii::CommandBuffer begin() const;
  // Submits and waits.
  void submit(const raii::CommandBuffer& commands) const;
};

struct BufferState {
  // more_usage: what a buffer of ray queries is for besides; it is then not bound as storage, whose limit it may pass.
  BufferState(std::shared_ptr<DeviceState> device, std::size_t bytes, Memory memory,
              ::vk::BufferUsageFlags more_usage = {});

  std::shared_ptr<DeviceState> device;
  std::size_t bytes = 0;      // as asked for
  std::size_t allocated = 0;  // of the Vulkan buffer
  raii::DeviceMemory memory = nullptr;
  raii::Buffer buffer = nullptr;
  std::byte* mapped = nullptr;                         // null: not host-visible
  bool cached = false;                                 // the host reads it fast
  raii::AccelerationStructureKHR structure = nullptr;  // that lies in this buffer
  std::shared_ptr<const BufferState> below;            // what the structure refers to
};

struct KernelState {
  std::shared_ptr<DeviceState> device;
  std::string name;
  std::vector<Binding> bindings;
  std::size_t push_constant_bytes = 0;
  raii::DescriptorSetLayout set_layout = nullptr;
  raii::PipelineLayout layout = nullptr;
  raii::Pipeline pipeline = nullptr;
};

[[nodiscard]] ::vk::DescriptorType descriptor_type(Binding binding);

struct CommandsState {
  explicit CommandsState(std::shared_ptr<DeviceState> device);

  // Throws std::logic_error once the commands have been run.
  raii::CommandBuffer& recording();
  void mark();
  // Closes the recording on the first call.
  void finish();
  [[nodiscard]] std::vector<StageTime> times() const;

  static constexpr std::uint32_t kMarksPerPool = 64;

  std::shared_ptr<DeviceState> device;
  std::vector<std::shared_ptr<const void>> kept;  // kernels and buffers in use
  std::vector<raii::BufferView> views;
  std::vector<raii::DescriptorPool> descriptor_pools;
  std::vector<raii::QueryPool> query_pools;
  std::uint32_t marks = 0;
  std::vector<std::string> stages;
  bool finished = false;
  raii::CommandBuffer commands = nullptr;
};

// All writes of shaders and copies before it become visible to shaders, copies and the host after it.
void record_barrier(const raii::CommandBuffer& commands);

}  // namespace render::vk
