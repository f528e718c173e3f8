// Compiled pipelines on disk. The file is a frame of our own (mark, size, checksum) around the driver's data, so that a
// damaged file never reaches the driver, which need not survive one.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace render::vk {

// Which device and driver cached data belongs to.
struct DriverId {
  std::uint32_t vendor = 0, device = 0;
  std::array<std::uint8_t, 16> cache_uuid{};
};

// The driver's data, or nothing where the file is missing, damaged or another driver's.
[[nodiscard]] std::vector<std::uint8_t> read_pipeline_cache(const std::filesystem::path& file, const DriverId& driver);

// All or nothing; throws DeviceError.
void write_pipeline_cache(const std::filesystem::path& file, std::span<const std::uint8_t> data);

}  // namespace render::vk
