#include "render/vk/device.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>

#include "render/vk/external.hpp"
#include "render/vk/handles.hpp"
#include "render/vk/pipeline_cache.hpp"

namespace render::vk {
namespace {

DeviceLimits limits_of(const raii::PhysicalDevice& physical, const ::vk::QueueFamilyProperties& family,
                       bool has_float64) {
  const auto properties =
      physical.getProperties2<::vk::PhysicalDeviceProperties2, ::vk::PhysicalDeviceVulkan11Properties>();
  const auto& device = properties.get<::vk::PhysicalDeviceProperties2>().properties.limits;
  DeviceLimits limits;
  limits.max_storage_buffer_bytes = device.maxStorageBufferRange;
  limits.max_texel_elements = device.maxTexelBufferElements;
  limits.max_uniform_buffer_bytes = device.maxUniformBufferRange;
  limits.max_push_constant_bytes = device.maxPushConstantsSize;
  for (std::size_t i = 0; i < 3; ++i) limits.max_groups[i] = device.maxComputeWorkGroupCount[i];
  limits.max_workgroup_invocations = device.maxComputeWorkGroupInvocations;
  const auto& core11 = properties.get<::vk::PhysicalDeviceVulkan11Properties>();
  limits.subgroup_size = core11.subgroupSize;
  using Operation = ::vk::SubgroupFeatureFlagBits;
  const auto needed = Operation::eBasic | Operation::eArithmetic | Operation::eBallot | Operation::eShuffle;
  limits.has_subgroup_reductions = (core11.subgroupSupportedOperations & needed) == needed &&
                                   bool(core11.subgroupSupportedStages & ::vk::ShaderStageFlagBits::eCompute);
  limits.shared_bytes = device.maxComputeSharedMemorySize;
  limits.timestamp_period_ns = family.timestampValidBits == 0 ? 0.0 : static_cast<double>(device.timestampPeriod);
  limits.has_float64 = has_float64;
  limits.on_processor =
      properties.get<::vk::PhysicalDeviceProperties2>().properties.deviceType == ::vk::PhysicalDeviceType::eCpu;
  return limits;
}

using FeatureChain =
    ::vk::StructureChain<::vk::PhysicalDeviceFeatures2, ::vk::PhysicalDeviceScalarBlockLayoutFeatures,
                         ::vk::PhysicalDeviceUniformBufferStandardLayoutFeatures,
                         ::vk::PhysicalDeviceBufferDeviceAddressFeatures,
                         ::vk::PhysicalDeviceAccelerationStructureFeaturesKHR, ::vk::PhysicalDeviceRayQueryFeaturesKHR>;

constexpr std::array kRayQueryExtensions{VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME, VK_KHR_RAY_QUERY_EXTENSION_NAME,
                                         VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME};

bool has_ray_query(const raii::PhysicalDevice& physical) {
  const auto extensions = physical.enumerateDeviceExtensionProperties();
  const auto is_offered = [&](std::string_view name) {
    return std::ranges::any_of(extensions, [&](const auto& e) { return name == e.extensionName.data(); });
  };
  if (!std::ranges::all_of(kRayQueryExtensions, is_offered)) return false;
  const auto offered = physical.getFeatures2<::vk::PhysicalDeviceFeatures2, ::vk::PhysicalDeviceVulkan12Features,
                                             ::vk::PhysicalDeviceAccelerationStructureFeaturesKHR,
                                             ::vk::PhysicalDeviceRayQueryFeaturesKHR>();
  return offered.get<::vk::PhysicalDeviceVulkan12Features>().bufferDeviceAddress &&
         offered.get<::vk::PhysicalDeviceAccelerationStructureFeaturesKHR>().accelerationStructure &&
         offered.get<::vk::PhysicalDeviceRayQueryFeaturesKHR>().rayQuery;
}

// Of what the device offers, what the shaders may use: the parity tests want doubles, the structs shared by C++ and
// GLSL scalar layout. One structure a feature: a maker that adds its own to the chain (timeline semaphores) may not
// find the one of all of Vulkan 1.2 there.
FeatureChain features_to_enable(const raii::PhysicalDevice& physical, bool ray_query) {
  const auto offered = physical.getFeatures2<::vk::PhysicalDeviceFeatures2, ::vk::PhysicalDeviceVulkan12Features>();
  const auto& core = offered.get<::vk::PhysicalDeviceFeatures2>().features;
  const auto& core12 = offered.get<::vk::PhysicalDeviceVulkan12Features>();
  FeatureChain wanted;
  wanted.get<::vk::PhysicalDeviceFeatures2>().features.setShaderFloat64(core.shaderFloat64);
  wanted.get<::vk::PhysicalDeviceFeatures2>().features.setShaderInt64(core.shaderInt64);
  wanted.get<::vk::PhysicalDeviceScalarBlockLayoutFeatures>().setScalarBlockLayout(core12.scalarBlockLayout);
  wanted.get<::vk::PhysicalDeviceUniformBufferStandardLayoutFeatures>().setUniformBufferStandardLayout(
      core12.uniformBufferStandardLayout);
  wanted.get<::vk::PhysicalDeviceBufferDeviceAddressFeatures>().setBufferDeviceAddress(ray_query);
  wanted.get<::vk::PhysicalDeviceAccelerationStructureFeaturesKHR>().setAccelerationStructure(VK_TRUE);
  wanted.get<::vk::PhysicalDeviceRayQueryFeaturesKHR>().setRayQuery(VK_TRUE);
  if (!ray_query) {
    wanted.unlink<::vk::PhysicalDeviceAccelerationStructureFeaturesKHR>();
    wanted.unlink<::vk::PhysicalDeviceRayQueryFeaturesKHR>();
  }
  return wanted;
}

std::vector<const char*> extensions_to_enable(bool ray_query, bool swapchain) {
  std::vector<const char*> names;
  if (ray_query) names.assign(kRayQueryExtensions.begin(), kRayQueryExtensions.end());
  if (swapchain) names.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
  return names;
}

raii::Device create_device(const raii::PhysicalDevice& physical, std::uint32_t queue_family,
                           const FeatureChain& features, const std::vector<const char*>& extensions,
                           const Instance& instance, const DeviceMaker* maker) {
  const float priority = 1.0F;
  const ::vk::DeviceQueueCreateInfo queue({}, queue_family, 1, &priority);
  ::vk::DeviceCreateInfo info({}, queue);
  info.setPNext(&features.get<::vk::PhysicalDeviceFeatures2>());
  info.setPEnabledExtensionNames(extensions);
  if (maker == nullptr) return {physical, info};
  const VkDeviceCreateInfo& plain = info;
  return {physical, maker->make_device(*physical, plain, instance.context.getDispatcher()->vkGetInstanceProcAddr)};
}

// A maker's own work on the queue may be drawing.
std::uint32_t choose_queue_family(const raii::PhysicalDevice& physical, const DeviceMaker* maker,
                                  const raii::SurfaceKHR& surface) {
  if (*surface) return showing_queue_family(physical, surface);
  if (maker != nullptr) {
    const auto family = queue_family_with(physical, ::vk::QueueFlagBits::eCompute | ::vk::QueueFlagBits::eGraphics);
    if (family != VK_QUEUE_FAMILY_IGNORED) return family;
  }
  return compute_queue_family(physical);
}

DriverId driver_id(const raii::PhysicalDevice& physical) {
  const auto properties = physical.getProperties();
  return {properties.vendorID, properties.deviceID, properties.pipelineCacheUUID};
}

raii::PhysicalDevice choose_device(const Instance& instance, const DeviceMaker* maker, const raii::SurfaceKHR& surface,
                                   const std::string& wanted) {
  if (maker != nullptr) return given_device(instance, *maker, wanted);
  const auto usable = usable_devices(instance);
  return *surface ? pick_showing_device(usable, wanted, surface) : pick_device(usable, wanted);
}

}  // namespace

DeviceState::DeviceState(const DeviceConfig& wanted)
    : config(wanted),
      instance(wanted.validation, wanted.maker,
               wanted.window != nullptr ? wanted.window->instance_extensions : std::vector<std::string>{}) {
  const DeviceMaker* const maker = std::exchange(config.maker, nullptr);
  const WindowBinding* const window = std::exchange(config.window, nullptr);
  if (maker != nullptr && window != nullptr) {
    throw std::invalid_argument("a device that is made in our place shows no window");
  }
  if (window != nullptr) surface = {instance.instance, window->make_surface(*instance.instance)};
  physical = choose_device(instance, maker, surface, config.device);
  name = physical.getProperties().deviceName.data();
  queue_family = choose_queue_family(physical, maker, surface);
  const auto family = physical.getQueueFamilyProperties()[queue_family];
  const std::uint32_t bits = family.timestampValidBits;
  timestamp_mask = bits >= 64 ? std::numeric_limits<std::uint64_t>::max() : (std::uint64_t{1} << bits) - 1;
  guarded("opening the device " + name, [&] {
    const bool ray_query = has_ray_query(physical);
    const FeatureChain features = features_to_enable(physical, ray_query);
    limits = limits_of(physical, family, bool(features.get<::vk::PhysicalDeviceFeatures2>().features.shaderFloat64));
    limits.has_ray_query = ray_query;
    device = create_device(physical, queue_family, features, extensions_to_enable(ray_query, bool(*surface)), instance,
                           maker);
    queue = device.getQueue(queue_family, 0);
    pool = {device, {::vk::CommandPoolCreateFlagBits::eResetCommandBuffer, queue_family}};
    std::vector<std::uint8_t> cached;
    if (!config.pipeline_cache.empty()) cached = read_pipeline_cache(config.pipeline_cache, driver_id(physical));
    cache = {device, ::vk::PipelineCacheCreateInfo({}, cached.size(), cached.data())};
  });
}

raii::CommandBuffer DeviceState::begin() const {
  raii::CommandBuffers buffers(device, {*pool, ::vk::CommandBufferLevel::ePrimary, 1});
  raii::CommandBuffer commands = std::move(buffers.front());
  commands.begin({});
  record_barrier(commands);  // after whatever was submitted before
  return commands;
}

void DeviceState::submit(const raii::CommandBuffer& commands) const {
  const raii::Fence done(device, ::vk::FenceCreateInfo());
  ::vk::SubmitInfo info;
  info.setCommandBuffers(*commands);
  queue.submit(info, *done);
  const auto result = device.waitForFences(*done, VK_TRUE, std::numeric_limits<std::uint64_t>::max());
  if (result != ::vk::Result::eSuccess) throw DeviceError("waiting for " + name + ": " + ::vk::to_string(result));
}

Device::Device(const DeviceConfig& config) : state_(std::make_shared<DeviceState>(config)) {}
Device::~Device() = default;
Device::Device(Device&&) noexcept = default;
Device& Device::operator=(Device&&) noexcept = default;

std::vector<std::string> Device::device_names() {
  const Instance instance(false);
  std::vector<std::string> names;
  for (const auto& device : usable_devices(instance)) names.emplace_back(device.getProperties().deviceName.data());
  return names;
}

const std::string& Device::name() const {
  return state_->name;
}
const DeviceLimits& Device::limits() const {
  return state_->limits;
}
std::vector<std::string> Device::validation_messages() const {
  return state_->instance.log.messages();
}

void Device::save_pipeline_cache() const {
  if (state_->config.pipeline_cache.empty()) return;
  const auto data = guarded("reading back the pipeline cache", [&] { return state_->cache.getData(); });
  write_pipeline_cache(state_->config.pipeline_cache, data);
}

std::vector<StageTime> Device::run(Commands& commands) {
  if (commands.state()->device != state_) throw std::invalid_argument("these commands were made for another device");
  return guarded("running commands on " + state_->name, [&] {
    commands.state()->finish();
    state_->submit(commands.state()->commands);
    return commands.state()->times();
  });
}

}  // namespace render::vk
