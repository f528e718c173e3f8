// Opens the GPU as --device asks, with validation in the validation build.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include "app/option_values.hpp"
#include "render/vk/device.hpp"

namespace app {

#ifdef VERGENCE_VALIDATION
inline constexpr bool kValidation = true;
#else
inline constexpr bool kValidation = false;
#endif

[[nodiscard]] inline render::vk::Device open_device(const std::string& name) {
  return render::vk::Device({.device = name, .validation = kValidation, .pipeline_cache = pipeline_cache_file()});
}

// Keeps what was compiled, and fails the command if the validation layers had anything to say.
inline void close_device(const render::vk::Device& device) {
  try {
    std::filesystem::create_directories(pipeline_cache_file().parent_path());
    device.save_pipeline_cache();
  } catch (const std::exception&) {
    // A cache that cannot be kept costs the next start a second; it is no reason to lose this picture.
  }
  if (const auto messages = device.validation_messages(); !messages.empty()) {
    throw std::runtime_error("--device: validation: " + messages.front());
  }
}

}  // namespace app
