#include "render/vk/pipeline_cache.hpp"

#include <cstring>
#include <fstream>
#include <iterator>
#include <string>

#include "render/image/output_error.hpp"
#include "render/image/output_file.hpp"
#include "render/vk/device.hpp"

namespace render::vk {
namespace {

struct Frame {
  char mark[8] = {'V', 'G', 'C', 'A', 'C', 'H', 'E', '1'};
  std::uint64_t bytes = 0;
  std::uint64_t checksum = 0;
};

// How the driver's data begins: the Vulkan specification, "Pipeline Cache Header", version one.
struct DriverHeader {
  std::uint32_t size, version, vendor, device;
  std::uint8_t cache_uuid[16];
};

// FNV-1a, 64 bit.
std::uint64_t checksum_of(std::span<const std::uint8_t> data) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const std::uint8_t byte : data) hash = (hash ^ byte) * 0x100000001b3U;
  return hash;
}

bool made_by(std::span<const std::uint8_t> data, const DriverId& driver) {
  DriverHeader header;
  if (data.size() < sizeof header) return false;
  std::memcpy(&header, data.data(), sizeof header);
  return header.size == sizeof header && header.version == 1 && header.vendor == driver.vendor &&
         header.device == driver.device &&
         std::memcmp(header.cache_uuid, driver.cache_uuid.data(), sizeof header.cache_uuid) == 0;
}

}  // namespace

std::vector<std::uint8_t> read_pipeline_cache(const std::filesystem::path& file, const DriverId& driver) {
  std::ifstream stream(file, std::ios::binary);
  const std::vector<char> contents{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  Frame frame;
  if (contents.size() < sizeof frame) return {};
  std::memcpy(&frame, contents.data(), sizeof frame);
  std::vector<std::uint8_t> data(contents.begin() + sizeof frame, contents.end());
  const bool whole = std::memcmp(frame.mark, Frame{}.mark, sizeof frame.mark) == 0 && frame.bytes == data.size() &&
                     frame.checksum == checksum_of(data);
  if (!whole || !made_by(data, driver)) return {};
  return data;
}

void write_pipeline_cache(const std::filesystem::path& file, std::span<const std::uint8_t> data) {
  Frame frame;
  frame.bytes = data.size();
  frame.checksum = checksum_of(data);
  std::vector<std::byte> contents(sizeof frame + data.size());
  std::memcpy(contents.data(), &frame, sizeof frame);
  if (!data.empty()) std::memcpy(contents.data() + sizeof frame, data.data(), data.size());
  try {
    write_file(file, contents);
  } catch (const OutputError& error) {
    throw DeviceError("pipeline cache " + std::string(error.what()));
  }
}

}  // namespace render::vk
