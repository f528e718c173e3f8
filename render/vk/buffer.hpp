// A buffer with its own memory. Any buffer may be bound as storage, uniform or texel buffer and copied from and to.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include "render/vk/device.hpp"

namespace render::vk {

struct BufferState;

enum class Memory {
  device,    // where the device reads fastest; read and written through staging copies where it cannot be mapped
  upload,    // mapped; the host writes often, the device reads
  readback,  // mapped and cached; the device writes, the host reads
};

class Buffer {
 public:
  // A buffer of no bytes is allowed and can be bound. More than DeviceLimits::max_storage_buffer_bytes: DeviceError.
  Buffer(const Device& device, std::size_t bytes, Memory memory);
  ~Buffer();
  Buffer(Buffer&&) noexcept;
  Buffer& operator=(Buffer&&) noexcept;
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;

  [[nodiscard]] std::size_t bytes() const;

  // Both are done when they return. A range beyond the end throws std::out_of_range.
  void write(std::span<const std::byte> data, std::size_t offset = 0);
  void read_bytes(std::span<std::byte> data, std::size_t offset = 0) const;

  template <class T>
  void write(const std::vector<T>& values, std::size_t offset = 0) {
    static_assert(std::is_trivially_copyable_v<T>);
    write(std::as_bytes(std::span(values)), offset);
  }

  // offset in bytes.
  template <class T>
  [[nodiscard]] std::vector<T> read(std::size_t count, std::size_t offset = 0) const {
    static_assert(std::is_trivially_copyable_v<T>);
    std::vector<T> values(count);
    read_bytes(std::as_writable_bytes(std::span(values)), offset);
    return values;
  }

  // For the other files of this folder.
  explicit Buffer(std::shared_ptr<BufferState> state) : state_(std::move(state)) {}
  [[nodiscard]] const std::shared_ptr<BufferState>& state() const { return state_; }

 private:
  std::shared_ptr<BufferState> state_;
};

}  // namespace render::vk
