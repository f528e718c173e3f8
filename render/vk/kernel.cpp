#include "render/vk/kernel.hpp"

#include <stdexcept>

#include "render/vk/handles.hpp"

namespace render::vk {
namespace {

raii::DescriptorSetLayout create_set_layout(const raii::Device& device, std::span<const Binding> bindings) {
  std::vector<::vk::DescriptorSetLayoutBinding> layout;
  for (const Binding binding : bindings) {
    layout.emplace_back(static_cast<std::uint32_t>(layout.size()), descriptor_type(binding), 1,
                        ::vk::ShaderStageFlagBits::eCompute);
  }
  return {device, ::vk::DescriptorSetLayoutCreateInfo({}, layout)};
}

raii::PipelineLayout create_layout(const raii::Device& device, const raii::DescriptorSetLayout& set_layout,
                                   std::size_t push_constant_bytes) {
  const ::vk::PushConstantRange range(::vk::ShaderStageFlagBits::eCompute, 0,
                                      static_cast<std::uint32_t>(push_constant_bytes));
  ::vk::PipelineLayoutCreateInfo info({}, *set_layout);
  if (push_constant_bytes > 0) info.setPushConstantRanges(range);
  return {device, info};
}

raii::Pipeline create_pipeline(const DeviceState& state, const raii::PipelineLayout& layout,
                               std::span<const std::uint32_t> spirv, std::span<const std::uint32_t> constants) {
  const raii::ShaderModule module(state.device, ::vk::ShaderModuleCreateInfo({}, spirv.size_bytes(), spirv.data()));
  std::vector<::vk::SpecializationMapEntry> entries;
  for (std::uint32_t id = 0; id < constants.size(); ++id) entries.emplace_back(id, id * 4, 4);
  const ::vk::SpecializationInfo specialization(static_cast<std::uint32_t>(entries.size()), entries.data(),
                                                constants.size_bytes(), constants.data());
  const ::vk::PipelineShaderStageCreateInfo stage({}, ::vk::ShaderStageFlagBits::eCompute, *module, "main",
                                                  &specialization);
  return {state.device, state.cache, ::vk::ComputePipelineCreateInfo({}, stage, *layout)};
}

}  // namespace

::vk::DescriptorType descriptor_type(Binding binding) {
  switch (binding) {
    case Binding::storage_buffer:
      return ::vk::DescriptorType::eStorageBuffer;
    case Binding::uniform_buffer:
      return ::vk::DescriptorType::eUniformBuffer;
    case Binding::texel_rgba32f:
    case Binding::texel_rgba32ui:
    case Binding::texel_rg32ui:
    case Binding::texel_r32ui:
    case Binding::texel_rgba8_unorm:
      return ::vk::DescriptorType::eUniformTexelBuffer;
    case Binding::acceleration_structure:
      return ::vk::DescriptorType::eAccelerationStructureKHR;
  }
  throw std::invalid_argument("unknown binding");
}

Kernel::Kernel(const Device& device, std::span<const std::uint32_t> spirv, std::span<const Binding> bindings,
               std::size_t push_constant_bytes, std::span<const std::uint32_t> specialization, std::string name)
    : state_(std::make_shared<KernelState>()) {
  const DeviceState& owner = *device.state();
  if (push_constant_bytes > owner.limits.max_push_constant_bytes) {
    throw DeviceError("kernel " + name + ": " + std::to_string(push_constant_bytes) +
                      " bytes of push constants are more than " + owner.name + " allows, " +
                      std::to_string(owner.limits.max_push_constant_bytes));
  }
  if (push_constant_bytes % 4 != 0) throw std::invalid_argument("push constants come in units of 4 bytes");
  state_->device = device.state();
  state_->name = std::move(name);
  state_->bindings.assign(bindings.begin(), bindings.end());
  state_->push_constant_bytes = push_constant_bytes;
  guarded("making the kernel " + state_->name, [&] {
    state_->set_layout = create_set_layout(owner.device, bindings);
    state_->layout = create_layout(owner.device, state_->set_layout, push_constant_bytes);
    state_->pipeline = create_pipeline(owner, state_->layout, spirv, specialization);
    owner.label(state_->pipeline, state_->name);
  });
}

Kernel::~Kernel() = default;
Kernel::Kernel(Kernel&&) noexcept = default;
Kernel& Kernel::operator=(Kernel&&) noexcept = default;

const std::string& Kernel::name() const {
  return state_->name;
}

}  // namespace render::vk
