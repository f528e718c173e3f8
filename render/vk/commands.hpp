// A recorded list of device work, run by Device::run as often as wanted. It keeps the kernels and buffers it names
// alive. Contents of buffers are read anew at each run; push constants stay as recorded. Once run, nothing more can be
// recorded.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <type_traits>

#include "render/vk/buffer.hpp"
#include "render/vk/kernel.hpp"

namespace render::vk {

struct CommandsState;

// The bytes of a push constant block.
template <class T>
[[nodiscard]] std::span<const std::byte> bytes_of(const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  return std::as_bytes(std::span(&value, 1));
}

class Commands {
 public:
  explicit Commands(const Device& device);
  ~Commands();
  Commands(Commands&&) noexcept;
  Commands& operator=(Commands&&) noexcept;
  Commands(const Commands&) = delete;
  Commands& operator=(const Commands&) = delete;

  // One buffer a binding of the kernel, in order; x, y, z count workgroups. A mismatch with the kernel throws
  // std::invalid_argument, a count or a buffer beyond the device's limits DeviceError.
  void dispatch(const Kernel& kernel, std::span<const Buffer* const> buffers, std::span<const std::byte> push_constants,
                std::uint32_t x, std::uint32_t y = 1, std::uint32_t z = 1);
  void dispatch(const Kernel& kernel, std::initializer_list<const Buffer*> buffers,
                std::span<const std::byte> push_constants, std::uint32_t x, std::uint32_t y = 1, std::uint32_t z = 1);

  // The same with the counts of workgroups x, y, z read from `counts`, at an offset of whole words, when it runs.
  // Counts beyond the device's limits are the caller's to avoid.
  void dispatch_indirect(const Kernel& kernel, std::span<const Buffer* const> buffers,
                         std::span<const std::byte> push_constants, const Buffer& counts, std::size_t offset = 0);

  // What follows sees all that was written before it. Runs follow each other and the host's reads and writes without
  // one.
  void barrier();

  void copy(const Buffer& from, Buffer& to, std::size_t bytes, std::size_t from_offset = 0, std::size_t to_offset = 0);
  void fill_zero(Buffer& buffer);
  // The buffer's first bytes become these: whole words, 65536 bytes at most.
  void update(Buffer& buffer, std::span<const std::byte> bytes);

  // Ends a stage: its time runs from the mark before, or from the beginning, until all work recorded so far is done.
  void timestamp(std::string stage_name);

  // For the other files of this folder.
  [[nodiscard]] const std::shared_ptr<CommandsState>& state() const { return state_; }

 private:
  std::shared_ptr<CommandsState> state_;
};

}  // namespace render::vk
