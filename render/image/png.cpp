#include "render/image/png.hpp"

#include <array>
#include <cstring>
#include <limits>
#include <memory>
#include <span>

#include "render/image/output_error.hpp"
#include "render/image/output_file.hpp"
#include "tracking/input_error.hpp"

// Static: other libraries carry their own copies of stb.
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#include <stb/stb_image.h>
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>

namespace render {
namespace {

// PNG specification, second edition, annex D: the CRC of a chunk, over its type and data.
std::uint32_t crc32(std::span<const std::byte> data) {
  std::uint32_t crc = 0xffffffffU;
  for (const std::byte byte : data) {
    crc ^= std::to_integer<std::uint32_t>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1U) != 0 ? (crc >> 1) ^ 0xedb88320U : crc >> 1;
  }
  return ~crc;
}

// Section 11.3.3.5: length 1, type sRGB, rendering intent 0 (perceptual), CRC.
std::array<std::byte, 13> srgb_chunk() {
  std::array<std::byte, 13> chunk{};
  chunk[3] = std::byte{1};
  std::memcpy(&chunk[4], "sRGB", 4);
  const std::uint32_t crc = crc32(std::span(chunk).subspan(4, 5));
  for (unsigned i = 0; i < 4; ++i) chunk[9 + i] = static_cast<std::byte>(crc >> (24 - 8 * i));
  return chunk;
}

void append(void* context, void* data, int size) {
  auto& bytes = *static_cast<std::vector<std::byte>*>(context);
  const auto* const begin = static_cast<const std::byte*>(data);
  bytes.insert(bytes.end(), begin, begin + size);
}

}  // namespace

void write_png(const std::filesystem::path& file, const Image8& image) {
  check_image(image);
  // The encoder counts in int.
  if (image.rgb.size() > static_cast<std::size_t>(std::numeric_limits<int>::max() / 2)) {
    throw OutputError(file.string(), "", "cannot be written: the picture is too large for PNG");
  }
  std::vector<std::byte> bytes;
  if (stbi_write_png_to_func(append, &bytes, image.width, image.height, 3, image.rgb.data(), 3 * image.width) == 0) {
    throw OutputError(file.string(), "", "cannot be written: the PNG encoder failed");
  }
  constexpr std::ptrdiff_t kAfterHeader = 8 + 25;  // signature and IHDR, which is always first
  const auto chunk = srgb_chunk();
  bytes.insert(bytes.begin() + kAfterHeader, chunk.begin(), chunk.end());
  write_file(file, bytes);
}

Image8 read_png(const std::filesystem::path& file) {
  Image8 image;
  int channels = 0;
  const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> pixels(
      stbi_load(file.c_str(), &image.width, &image.height, &channels, 3), &stbi_image_free);
  if (pixels == nullptr) {
    throw tracking::InputError(file.string(), "", "cannot be read as PNG: " + std::string(stbi_failure_reason()));
  }
  const std::size_t size = 3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  image.rgb.assign(pixels.get(), pixels.get() + size);
  return image;
}

}  // namespace render
