#include "render/vk/commands.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>

#include "render/vk/handles.hpp"

namespace render::vk {
namespace {

constexpr std::size_t kLargestUpdate = 65536;  // vkCmdUpdateBuffer's

struct TexelKind {
  ::vk::Format format;
  std::size_t bytes;
};

TexelKind texel_kind(Binding binding) {
  switch (binding) {
    case Binding::texel_rgba32f:
      return {::vk::Format::eR32G32B32A32Sfloat, 16};
    case Binding::texel_rgba32ui:
      return {::vk::Format::eR32G32B32A32Uint, 16};
    case Binding::texel_rg32ui:
      return {::vk::Format::eR32G32Uint, 8};
    case Binding::texel_r32ui:
      return {::vk::Format::eR32Uint, 4};
    case Binding::texel_rgba8_unorm:
      return {::vk::Format::eR8G8B8A8Unorm, 4};
    default:
      throw std::invalid_argument("not a texel binding");
  }
}

std::string place(const KernelState& kernel, std::size_t binding) {
  return "kernel " + kernel.name + ": binding " + std::to_string(binding);
}

raii::BufferView texel_view(const DeviceState& device, const BufferState& buffer, Binding binding,
                            const std::string& where) {
  const TexelKind kind = texel_kind(binding);
  const std::size_t elements = std::max<std::size_t>(1, buffer.bytes / kind.bytes);
  if (elements > device.limits.max_texel_elements) {
    throw DeviceError(where + ": " + std::to_string(elements) + " texels are more than " + device.name + " allows, " +
                      std::to_string(device.limits.max_texel_elements));
  }
  return {device.device, ::vk::BufferViewCreateInfo({}, *buffer.buffer, kind.format, 0, elements * kind.bytes)};
}

void check_dispatch(const KernelState& kernel, std::span<const Buffer* const> buffers,
                    std::span<const std::byte> push_constants, const std::array<std::uint32_t, 3>& groups) {
  const auto mismatch = [&](const std::string& what, std::size_t is, std::size_t needed) {
    throw std::invalid_argument("kernel " + kernel.name + ": " + std::to_string(is) + " " + what + ", it takes " +
                                std::to_string(needed));
  };
  if (buffers.size() != kernel.bindings.size()) mismatch("buffers", buffers.size(), kernel.bindings.size());
  if (push_constants.size() != kernel.push_constant_bytes) {
    mismatch("bytes of push constants", push_constants.size(), kernel.push_constant_bytes);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t limit = kernel.device->limits.max_groups[i];
    if (groups[i] > limit) {
      throw DeviceError("kernel " + kernel.name + ": " + std::to_string(groups[i]) + " workgroups along axis " +
                        std::to_string(i) + " are more than " + kernel.device->name + " allows, " +
                        std::to_string(limit));
    }
  }
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    const std::size_t limit = kernel.device->limits.max_uniform_buffer_bytes;
    const std::size_t bytes = buffers[i]->bytes();
    if (kernel.bindings[i] == Binding::uniform_buffer && bytes > limit) {
      throw DeviceError(place(kernel, i) + ": a uniform buffer of " + std::to_string(bytes) + " bytes is more than " +
                        kernel.device->name + " allows, " + std::to_string(limit));
    }
    if (kernel.bindings[i] == Binding::acceleration_structure && !*buffers[i]->state()->structure) {
      throw std::invalid_argument(place(kernel, i) + ": the buffer holds no acceleration structure");
    }
  }
}

// A pool of exactly one set: sets live as long as their commands, so there is nothing to share or give back.
raii::DescriptorPool pool_for(const raii::Device& device, const KernelState& kernel) {
  std::map<::vk::DescriptorType, std::uint32_t> counts;
  for (const Binding binding : kernel.bindings) ++counts[descriptor_type(binding)];
  std::vector<::vk::DescriptorPoolSize> sizes;
  for (const auto& [type, count] : counts) sizes.emplace_back(type, count);
  return {device, ::vk::DescriptorPoolCreateInfo({}, 1, sizes)};
}

::vk::DescriptorSet allocate_set(CommandsState& commands, const KernelState& kernel) {
  const raii::Device& device = commands.device->device;
  commands.descriptor_pools.push_back(pool_for(device, kernel));
  const ::vk::DescriptorSetAllocateInfo info(*commands.descriptor_pools.back(), *kernel.set_layout);
  // Released: the set goes with its pool.
  return raii::DescriptorSets(device, info).front().release();
}

::vk::DescriptorSet bound_set(CommandsState& commands, const KernelState& kernel,
                              std::span<const Buffer* const> buffers) {
  const ::vk::DescriptorSet set = allocate_set(commands, kernel);
  std::vector<::vk::DescriptorBufferInfo> infos(buffers.size());
  std::vector<::vk::BufferView> views(buffers.size());
  std::vector<::vk::WriteDescriptorSetAccelerationStructureKHR> structures(buffers.size());
  std::vector<::vk::WriteDescriptorSet> writes;
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    const BufferState& buffer = *buffers[i]->state();
    const auto type = descriptor_type(kernel.bindings[i]);
    ::vk::WriteDescriptorSet write(set, static_cast<std::uint32_t>(i), 0, 1, type);
    if (type == ::vk::DescriptorType::eUniformTexelBuffer) {
      commands.views.push_back(texel_view(*commands.device, buffer, kernel.bindings[i], place(kernel, i)));
      views[i] = *commands.views.back();
      write.setPTexelBufferView(&views[i]);
    } else if (type == ::vk::DescriptorType::eAccelerationStructureKHR) {
      structures[i].setAccelerationStructures(*buffer.structure);
      write.setPNext(&structures[i]);
    } else {
      infos[i] = ::vk::DescriptorBufferInfo(*buffer.buffer, 0, buffer.bytes == 0 ? buffer.allocated : buffer.bytes);
      write.setPBufferInfo(&infos[i]);
    }
    writes.push_back(write);
  }
  commands.device->device.updateDescriptorSets(writes, {});
  return set;
}

}  // namespace

void record_barrier(const raii::CommandBuffer& commands) {
  using Stage = ::vk::PipelineStageFlagBits;
  using Access = ::vk::AccessFlagBits;
  const ::vk::MemoryBarrier barrier(Access::eShaderWrite | Access::eTransferWrite,
                                    Access::eShaderRead | Access::eShaderWrite | Access::eUniformRead |
                                        Access::eTransferRead | Access::eTransferWrite | Access::eHostRead |
                                        Access::eHostWrite | Access::eIndirectCommandRead);
  commands.pipelineBarrier(Stage::eComputeShader | Stage::eTransfer,
                           Stage::eComputeShader | Stage::eTransfer | Stage::eHost | Stage::eDrawIndirect, {}, barrier,
                           {}, {});
}

CommandsState::CommandsState(std::shared_ptr<DeviceState> owner) : device(std::move(owner)) {
  guarded("beginning commands", [&] {
    commands = device->begin();
    mark();
  });
}

raii::CommandBuffer& CommandsState::recording() {
  if (finished) throw std::logic_error("commands cannot be added to after they have been run");
  return commands;
}

void CommandsState::mark() {
  if (device->limits.timestamp_period_ns == 0.0) return;
  if (marks % kMarksPerPool == 0) {
    query_pools.emplace_back(device->device, ::vk::QueryPoolCreateInfo({}, ::vk::QueryType::eTimestamp, kMarksPerPool));
    recording().resetQueryPool(*query_pools.back(), 0, kMarksPerPool);
  }
  recording().writeTimestamp(::vk::PipelineStageFlagBits::eBottomOfPipe, *query_pools.back(), marks % kMarksPerPool);
  ++marks;
}

void CommandsState::finish() {
  if (finished) return;
  record_barrier(commands);
  commands.end();
  finished = true;
}

std::vector<StageTime> CommandsState::times() const {
  std::vector<std::uint64_t> ticks;
  for (std::size_t pool = 0; pool < query_pools.size(); ++pool) {
    const auto count = std::min(kMarksPerPool, marks - static_cast<std::uint32_t>(pool) * kMarksPerPool);
    const auto [result, values] =
        query_pools[pool].getResults<std::uint64_t>(0, count, count * sizeof(std::uint64_t), sizeof(std::uint64_t),
                                                    ::vk::QueryResultFlagBits::e64 | ::vk::QueryResultFlagBits::eWait);
    ticks.insert(ticks.end(), values.begin(), values.end());
  }
  std::vector<StageTime> times;
  for (std::size_t i = 1; i < ticks.size(); ++i) {
    const auto elapsed = static_cast<double>((ticks[i] - ticks[i - 1]) & device->timestamp_mask);
    times.push_back({stages[i - 1], elapsed * device->limits.timestamp_period_ns * 1e-6});
  }
  return times;
}

Commands::Commands(const Device& device) : state_(std::make_shared<CommandsState>(device.state())) {}
Commands::~Commands() = default;
Commands::Commands(Commands&&) noexcept = default;
Commands& Commands::operator=(Commands&&) noexcept = default;

namespace {

void bind(CommandsState& state, const Kernel& kernel, std::span<const Buffer* const> buffers,
          std::span<const std::byte> push_constants) {
  const KernelState& made = *kernel.state();
  auto& commands = state.recording();
  commands.bindPipeline(::vk::PipelineBindPoint::eCompute, *made.pipeline);
  if (!buffers.empty()) {
    const auto set = bound_set(state, made, buffers);
    commands.bindDescriptorSets(::vk::PipelineBindPoint::eCompute, *made.layout, 0, set, {});
  }
  if (!push_constants.empty()) {
    commands.pushConstants<std::byte>(*made.layout, ::vk::ShaderStageFlagBits::eCompute, 0, push_constants);
  }
  state.kept.push_back(kernel.state());
  for (const Buffer* buffer : buffers) state.kept.push_back(buffer->state());
}

}  // namespace

void Commands::dispatch(const Kernel& kernel, std::span<const Buffer* const> buffers,
                        std::span<const std::byte> push_constants, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  const KernelState& made = *kernel.state();
  auto& commands = state_->recording();
  check_dispatch(made, buffers, push_constants, {x, y, z});
  guarded("recording the kernel " + made.name, [&] {
    bind(*state_, kernel, buffers, push_constants);
    commands.dispatch(x, y, z);
  });
}

void Commands::dispatch_indirect(const Kernel& kernel, std::span<const Buffer* const> buffers,
                                 std::span<const std::byte> push_constants, const Buffer& counts, std::size_t offset) {
  const KernelState& made = *kernel.state();
  auto& commands = state_->recording();
  check_dispatch(made, buffers, push_constants, {1, 1, 1});
  if (offset % 4 != 0 || counts.bytes() < offset + 3 * sizeof(std::uint32_t)) {
    throw std::invalid_argument("kernel " + made.name + ": three counts of workgroups are 12 bytes, not " +
                                std::to_string(counts.bytes()) + " from " + std::to_string(offset) + " on");
  }
  guarded("recording the kernel " + made.name, [&] {
    bind(*state_, kernel, buffers, push_constants);
    commands.dispatchIndirect(*counts.state()->buffer, offset);
  });
  state_->kept.push_back(counts.state());
}

void Commands::dispatch(const Kernel& kernel, std::initializer_list<const Buffer*> buffers,
                        std::span<const std::byte> push_constants, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  dispatch(kernel, std::span(buffers.begin(), buffers.size()), push_constants, x, y, z);
}

void Commands::barrier() {
  record_barrier(state_->recording());
}

void Commands::copy(const Buffer& from, Buffer& to, std::size_t bytes, std::size_t from_offset, std::size_t to_offset) {
  const auto inside = [bytes](const Buffer& buffer, std::size_t offset) {
    return offset <= buffer.bytes() && bytes <= buffer.bytes() - offset;
  };
  if (!inside(from, from_offset) || !inside(to, to_offset)) {
    throw std::out_of_range("a copy of " + std::to_string(bytes) + " bytes does not fit its buffers, " +
                            std::to_string(from.bytes()) + " and " + std::to_string(to.bytes()) + " bytes");
  }
  if (bytes == 0) return;
  state_->recording().copyBuffer(*from.state()->buffer, *to.state()->buffer,
                                 ::vk::BufferCopy(from_offset, to_offset, bytes));
  state_->kept.push_back(from.state());
  state_->kept.push_back(to.state());
}

void Commands::fill_zero(Buffer& buffer) {
  state_->recording().fillBuffer(*buffer.state()->buffer, 0, VK_WHOLE_SIZE, 0);
  state_->kept.push_back(buffer.state());
}

void Commands::update(Buffer& buffer, std::span<const std::byte> bytes) {
  if (bytes.size() > buffer.bytes() || bytes.size() > kLargestUpdate || bytes.size() % 4 != 0) {
    throw std::out_of_range("an update of " + std::to_string(bytes.size()) + " bytes must fit its buffer of " +
                            std::to_string(buffer.bytes()) + ", be whole words and at most 65536");
  }
  state_->recording().updateBuffer<std::byte>(*buffer.state()->buffer, 0, bytes);
  state_->kept.push_back(buffer.state());
}

void Commands::timestamp(std::string stage_name) {
  (void)state_->recording();  // before the name is taken: a finished recording stays as it is
  guarded("recording the end of stage " + stage_name, [&] { state_->mark(); });
  state_->stages.push_back(std::move(stage_name));
}

}  // namespace render::vk
