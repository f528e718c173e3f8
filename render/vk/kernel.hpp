// A compute shader made ready to dispatch: entry point "main", descriptor set 0, binding = index.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "render/vk/device.hpp"

namespace render::vk {

struct KernelState;

// How the shader sees a buffer. The texel kinds are uniform texel buffers (samplerBuffer, usamplerBuffer).
enum class Binding {
  storage_buffer,
  uniform_buffer,
  texel_rgba32f,
  texel_rgba32ui,
  texel_rg32ui,
  texel_r32ui,
  texel_rgba8_unorm,
  acceleration_structure  // Acceleration::top
};

class Kernel {
 public:
  // specialization[i] is the value of constant_id i, as the bits of a uint, int, float or bool. The name is for
  // messages only.
  Kernel(const Device& device, std::span<const std::uint32_t> spirv, std::span<const Binding> bindings,
         std::size_t push_constant_bytes, std::span<const std::uint32_t> specialization = {}, std::string name = {});
  ~Kernel();
  Kernel(Kernel&&) noexcept;
  Kernel& operator=(Kernel&&) noexcept;
  Kernel(const Kernel&) = delete;
  Kernel& operator=(const Kernel&) = delete;

  [[nodiscard]] const std::string& name() const;

  // For the other files of this folder.
  [[nodiscard]] const std::shared_ptr<KernelState>& state() const { return state_; }

 private:
  std::shared_ptr<KernelState> state_;
};

}  // namespace render::vk
