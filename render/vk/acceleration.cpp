#include "render/vk/acceleration.hpp"

#include <cstring>
#include <stdexcept>
#include <string>

#include "render/vk/handles.hpp"

namespace render::vk {
namespace {

using Usage = ::vk::BufferUsageFlagBits;
using Access = ::vk::AccessFlagBits;
using Stage = ::vk::PipelineStageFlagBits;

constexpr std::size_t kCornersATriangle = 3, kFloatsACorner = 3;

::vk::DeviceAddress address_of(const BufferState& buffer) {
  return buffer.device->device.getBufferAddress({*buffer.buffer});
}

template <class T>
BufferState input_buffer(const std::shared_ptr<DeviceState>& device, const T* data, std::size_t bytes) {
  BufferState buffer(device, bytes, Memory::upload,
                     Usage::eShaderDeviceAddress | Usage::eAccelerationStructureBuildInputReadOnlyKHR);
  if (bytes > 0) std::memcpy(buffer.mapped, data, bytes);
  return buffer;
}

// Allocates one level and builds it; the device is done with its input on return.
std::shared_ptr<BufferState> build_level(const std::shared_ptr<DeviceState>& device,
                                         ::vk::AccelerationStructureTypeKHR type,
                                         const ::vk::AccelerationStructureGeometryKHR& geometry, std::uint32_t count) {
  ::vk::AccelerationStructureBuildGeometryInfoKHR info(type,
                                                       ::vk::BuildAccelerationStructureFlagBitsKHR::ePreferFastTrace);
  info.setGeometries(geometry);
  const auto sizes = device->device.getAccelerationStructureBuildSizesKHR(
      ::vk::AccelerationStructureBuildTypeKHR::eDevice, info, count);
  auto level = std::make_shared<BufferState>(device, sizes.accelerationStructureSize, Memory::device,
                                             Usage::eShaderDeviceAddress | Usage::eAccelerationStructureStorageKHR);
  level->structure = {device->device, ::vk::AccelerationStructureCreateInfoKHR({}, *level->buffer, 0,
                                                                               sizes.accelerationStructureSize, type)};
  const auto properties =
      device->physical
          .getProperties2<::vk::PhysicalDeviceProperties2, ::vk::PhysicalDeviceAccelerationStructurePropertiesKHR>();
  const ::vk::DeviceSize alignment = properties.get<::vk::PhysicalDeviceAccelerationStructurePropertiesKHR>()
                                         .minAccelerationStructureScratchOffsetAlignment;
  const BufferState scratch(device, sizes.buildScratchSize + alignment, Memory::device, Usage::eShaderDeviceAddress);
  info.setDstAccelerationStructure(*level->structure)
      .setScratchData((address_of(scratch) + alignment - 1) / alignment * alignment);
  const ::vk::AccelerationStructureBuildRangeInfoKHR range(count, 0, 0, 0);
  const auto commands = device->begin();
  commands.buildAccelerationStructuresKHR(info, &range);
  commands.pipelineBarrier(
      Stage::eAccelerationStructureBuildKHR, Stage::eAccelerationStructureBuildKHR | Stage::eComputeShader, {},
      ::vk::MemoryBarrier(Access::eAccelerationStructureWriteKHR, Access::eAccelerationStructureReadKHR), {}, {});
  commands.end();
  device->submit(commands);
  return level;
}

std::shared_ptr<BufferState> bottom_level(const std::shared_ptr<DeviceState>& device,
                                          const std::vector<float>& corners) {
  const BufferState input = input_buffer(device, corners.data(), corners.size() * sizeof(float));
  const auto corner_count = static_cast<std::uint32_t>(corners.size() / kFloatsACorner);
  const ::vk::AccelerationStructureGeometryTrianglesDataKHR triangles(
      ::vk::Format::eR32G32B32Sfloat, address_of(input), kFloatsACorner * sizeof(float),
      corner_count == 0 ? 0 : corner_count - 1, ::vk::IndexType::eNoneKHR);
  return build_level(device, ::vk::AccelerationStructureTypeKHR::eBottomLevel,
                     {::vk::GeometryTypeKHR::eTriangles, triangles}, corner_count / kCornersATriangle);
}

std::shared_ptr<BufferState> top_level(const std::shared_ptr<DeviceState>& device,
                                       const std::shared_ptr<BufferState>& bottom) {
  constexpr std::uint32_t kEveryRay = 0xFF;
  const ::vk::TransformMatrixKHR as_it_stands(
      {{{{1.0F, 0.0F, 0.0F, 0.0F}}, {{0.0F, 1.0F, 0.0F, 0.0F}}, {{0.0F, 0.0F, 1.0F, 0.0F}}}});
  const auto reference = device->device.getAccelerationStructureAddressKHR({*bottom->structure});
  const ::vk::AccelerationStructureInstanceKHR instance(as_it_stands, 0, kEveryRay, 0, {}, reference);
  const BufferState input = input_buffer(device, &instance, sizeof instance);
  const ::vk::AccelerationStructureGeometryInstancesDataKHR instances(VK_FALSE, address_of(input));
  auto top = build_level(device, ::vk::AccelerationStructureTypeKHR::eTopLevel,
                         {::vk::GeometryTypeKHR::eInstances, instances}, 1);
  top->below = bottom;
  return top;
}

}  // namespace

Acceleration build_acceleration(const Device& device, const std::vector<float>& corners) {
  const std::shared_ptr<DeviceState>& state = device.state();
  if (!state->limits.has_ray_query) throw std::invalid_argument(state->name + " has no ray queries");
  const std::size_t triangles = corners.size() / (kCornersATriangle * kFloatsACorner);
  return guarded("building the acceleration structure on " + state->name, [&] {
    const auto properties =
        state->physical
            .getProperties2<::vk::PhysicalDeviceProperties2, ::vk::PhysicalDeviceAccelerationStructurePropertiesKHR>();
    const auto most = properties.get<::vk::PhysicalDeviceAccelerationStructurePropertiesKHR>().maxPrimitiveCount;
    if (triangles > most) {
      throw DeviceError(std::to_string(triangles) + " triangles are more than the acceleration structure of " +
                        state->name + " takes, " + std::to_string(most));
    }
    const auto bottom = bottom_level(state, corners);
    auto top = top_level(state, bottom);
    const std::size_t bytes = bottom->bytes + top->bytes;
    return Acceleration{Buffer(std::move(top)), bytes};
  });
}

}  // namespace render::vk
