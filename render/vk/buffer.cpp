#include "render/vk/buffer.hpp"

#include <algorithm>
#include <cstring>
#include <optional>
#include <stdexcept>

#include "render/vk/handles.hpp"

namespace render::vk {
namespace {

using Property = ::vk::MemoryPropertyFlagBits;

// The largest texel and the unit of fills: every kind of view has at least one whole element.
constexpr std::size_t kGranule = 16;

struct Preference {
  ::vk::MemoryPropertyFlags flags;
  bool largest_heap_only;
};

std::vector<Preference> preferences(Memory memory) {
  const auto host = Property::eHostVisible | Property::eHostCoherent;
  switch (memory) {
    case Memory::device:
      // Mapped device memory on a discrete GPU counts only where all of it is mapped: the window of 256 MiB that older
      // buses give is scarce and wanted by the driver itself.
      return {{Property::eDeviceLocal | host | Property::eHostCached, true},
              {Property::eDeviceLocal | host, true},
              {Property::eDeviceLocal, false},
              {{}, false}};
    case Memory::upload:
      return {{host, false}};
    case Memory::readback:
      return {{host | Property::eHostCached, false}, {host, false}};
  }
  throw std::invalid_argument("unknown kind of memory");
}

::vk::DeviceSize largest_device_heap(const ::vk::PhysicalDeviceMemoryProperties& properties) {
  ::vk::DeviceSize largest = 0;
  for (std::uint32_t i = 0; i < properties.memoryHeapCount; ++i) {
    const auto& heap = properties.memoryHeaps[i];
    if (heap.flags & ::vk::MemoryHeapFlagBits::eDeviceLocal) largest = std::max(largest, heap.size);
  }
  return largest;
}

// Memory types in the order to try them.
std::vector<std::uint32_t> candidates(const ::vk::PhysicalDeviceMemoryProperties& properties, std::uint32_t allowed,
                                      Memory memory) {
  const ::vk::DeviceSize largest = largest_device_heap(properties);
  std::vector<std::uint32_t> types;
  for (const Preference& wanted : preferences(memory)) {
    for (std::uint32_t i = 0; i < properties.memoryTypeCount; ++i) {
      const auto& type = properties.memoryTypes[i];
      if ((allowed & (1U << i)) == 0 || (type.propertyFlags & wanted.flags) != wanted.flags) continue;
      if (wanted.largest_heap_only && properties.memoryHeaps[type.heapIndex].size < largest) continue;
      if (std::ranges::find(types, i) == types.end()) types.push_back(i);
    }
  }
  return types;
}

std::optional<raii::DeviceMemory> try_allocate(const raii::Device& device, ::vk::DeviceSize bytes, std::uint32_t type,
                                               bool has_address) {
  const ::vk::MemoryAllocateFlagsInfo addressed(::vk::MemoryAllocateFlagBits::eDeviceAddress);
  try {
    return raii::DeviceMemory(device, {bytes, type, has_address ? &addressed : nullptr});
  } catch (const ::vk::OutOfDeviceMemoryError&) {
    return std::nullopt;  // another heap may have room
  }
}

void check_range(const BufferState& buffer, std::size_t bytes, std::size_t offset) {
  if (offset <= buffer.bytes && bytes <= buffer.bytes - offset) return;
  throw std::out_of_range("bytes " + std::to_string(offset) + " to " + std::to_string(offset + bytes) +
                          " of a buffer of " + std::to_string(buffer.bytes));
}

void copy_now(const BufferState& from, const BufferState& to, ::vk::BufferCopy region) {
  const auto commands = from.device->begin();
  commands.copyBuffer(*from.buffer, *to.buffer, region);
  record_barrier(commands);
  commands.end();
  from.device->submit(commands);
}

}  // namespace

BufferState::BufferState(std::shared_ptr<DeviceState> owner, std::size_t wanted, Memory kind,
                         ::vk::BufferUsageFlags more_usage)
    : device(std::move(owner)),
      bytes(wanted),
      allocated(std::max(kGranule, (wanted + kGranule - 1) / kGranule * kGranule)) {
  const std::size_t limit = device->limits.max_storage_buffer_bytes;
  if (!more_usage && bytes > limit) {
    throw DeviceError("a buffer of " + std::to_string(bytes) + " bytes is more than " + device->name + " allows, " +
                      std::to_string(limit));
  }
  using Usage = ::vk::BufferUsageFlagBits;
  const auto usage = Usage::eStorageBuffer | Usage::eUniformBuffer | Usage::eUniformTexelBuffer | Usage::eTransferSrc |
                     Usage::eTransferDst | Usage::eIndirectBuffer | more_usage;
  const bool has_address = bool(more_usage & Usage::eShaderDeviceAddress);
  const std::string what = "allocating a buffer of " + std::to_string(bytes) + " bytes on " + device->name;
  guarded(what, [&] {
    buffer = {device->device, ::vk::BufferCreateInfo({}, allocated, usage)};
    const auto needs = buffer.getMemoryRequirements();
    const auto properties = device->physical.getMemoryProperties();
    for (const std::uint32_t type : candidates(properties, needs.memoryTypeBits, kind)) {
      auto found = try_allocate(device->device, needs.size, type, has_address);
      if (!found) continue;
      memory = std::move(*found);
      buffer.bindMemory(*memory, 0);
      const auto flags = properties.memoryTypes[type].propertyFlags;
      // Only coherent memory is mapped: nothing here flushes or invalidates.
      const bool mappable = (flags & Property::eHostVisible) && (flags & Property::eHostCoherent) &&
                            (kind != Memory::device || device->config.map_device_memory);
      if (mappable) mapped = static_cast<std::byte*>(memory.mapMemory(0, VK_WHOLE_SIZE));
      cached = mappable && (flags & Property::eHostCached);
      return;
    }
    throw DeviceError(what + ": the device is out of memory");
  });
}

Buffer::Buffer(const Device& device, std::size_t bytes, Memory memory)
    : state_(std::make_shared<BufferState>(device.state(), bytes, memory)) {}
Buffer::~Buffer() = default;
Buffer::Buffer(Buffer&&) noexcept = default;
Buffer& Buffer::operator=(Buffer&&) noexcept = default;

std::size_t Buffer::bytes() const {
  return state_->bytes;
}

void Buffer::write(std::span<const std::byte> data, std::size_t offset) {
  check_range(*state_, data.size(), offset);
  if (data.empty()) return;
  if (state_->mapped != nullptr) {
    std::memcpy(state_->mapped + offset, data.data(), data.size());
    return;
  }
  const BufferState staging(state_->device, data.size(), Memory::upload);
  std::memcpy(staging.mapped, data.data(), data.size());
  guarded("writing to a buffer", [&] { copy_now(staging, *state_, {0, offset, data.size()}); });
}

void Buffer::read_bytes(std::span<std::byte> data, std::size_t offset) const {
  check_range(*state_, data.size(), offset);
  if (data.empty()) return;
  // Mapped memory that the host does not cache is read byte by byte over the bus: a copy first is far faster.
  if (state_->mapped != nullptr && (state_->cached || data.size() <= 64)) {
    std::memcpy(data.data(), state_->mapped + offset, data.size());
    return;
  }
  const BufferState staging(state_->device, data.size(), Memory::readback);
  guarded("reading a buffer", [&] { copy_now(*state_, staging, {offset, 0, data.size()}); });
  std::memcpy(data.data(), staging.mapped, data.size());
}

}  // namespace render::vk
