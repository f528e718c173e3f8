#include <stb/stb_image.h>

#include <array>
#include <climits>
#include <cstring>
#include <memory>

#include "render/scene/gltf_material.hpp"

namespace render {
namespace {

constexpr int kLargestEdge = 16384;
// A picture of a few kilobytes may unpack to a gigabyte; decoding takes several times an image's own size.
constexpr std::int64_t kMostPixels = std::int64_t{1} << 26;
// What follows a picture's end in its file is read with it, once a texture.
constexpr std::size_t kMostEncoded = std::size_t{1} << 31;

Texture::Wrap wrap_mode(const GltfDocument& document, int sampler, const char* name, int mode) {
  switch (mode) {
    case TINYGLTF_TEXTURE_WRAP_REPEAT:
      return Texture::Wrap::repeat;
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
      return Texture::Wrap::clamp;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
      return Texture::Wrap::mirror;
    default:
      document.fail("samplers[" + std::to_string(sampler) + "]." + name,
                    "is " + std::to_string(mode) + "; 10497, 33071 and 33648 are allowed");
  }
}

// The encoded bytes, and the field they come from.
std::vector<std::uint8_t> encoded_image(const GltfDocument& document, int index, std::string& field) {
  const tinygltf::Image& image = document.model.images.at(static_cast<std::size_t>(index));
  field = "images[" + std::to_string(index) + "]";
  if (image.bufferView >= 0) {
    field += ".bufferView";
    const auto bytes = document.view_bytes(image.bufferView);
    return {bytes.begin(), bytes.end()};
  }
  field += ".uri";
  return image.as_is ? image.image : read_external_file(document, image.uri, field);
}

// glTF 2.0, section 3.8.3: PNG and JPEG only, told apart by their first bytes.
bool is_png_or_jpeg(const std::vector<std::uint8_t>& bytes) {
  constexpr std::array<std::uint8_t, 8> kPng = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  constexpr std::array<std::uint8_t, 3> kJpeg = {0xFF, 0xD8, 0xFF};
  const auto begins = [&](const auto& magic) {
    return bytes.size() > magic.size() && std::memcmp(bytes.data(), magic.data(), magic.size()) == 0;
  };
  return begins(kPng) || begins(kJpeg);
}

void decode(const GltfDocument& document, const std::vector<std::uint8_t>& bytes, const std::string& field,
            Texture& texture) {
  const auto broken = [&](const char* why) {
    document.fail(field, std::string("cannot be decoded: ") + (why != nullptr ? why : "unknown") +
                             "; a PNG or JPEG image is allowed");
  };
  if (!is_png_or_jpeg(bytes)) broken("neither PNG nor JPEG");
  if (bytes.size() > INT_MAX) broken("larger than 2 GiB");
  const auto size = static_cast<int>(bytes.size());
  int width = 0, height = 0, channels = 0;
  if (stbi_info_from_memory(bytes.data(), size, &width, &height, &channels) == 0) broken(stbi_failure_reason());
  if (width < 1 || height < 1 || width > kLargestEdge || height > kLargestEdge) {
    document.fail(field, "is " + std::to_string(width) + " x " + std::to_string(height) +
                             " pixels; 1 to 16384 each way are allowed");
  }
  if (std::int64_t{width} * height > kMostPixels) {
    document.fail(
        field, "is " + std::to_string(width) + " x " + std::to_string(height) + " pixels; 67108864 in all are allowed");
  }
  const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> pixels(
      stbi_load_from_memory(bytes.data(), size, &width, &height, &channels, 4), stbi_image_free);
  if (!pixels) broken(stbi_failure_reason());
  texture.width = static_cast<std::uint32_t>(width);
  texture.height = static_cast<std::uint32_t>(height);
  texture.rgba.assign(pixels.get(), pixels.get() + std::size_t{texture.width} * texture.height * 4);
}

}  // namespace

Texture read_texture(const GltfDocument& document, int index) {
  const tinygltf::Texture& source = document.model.textures.at(static_cast<std::size_t>(index));
  if (source.source < 0) {
    document.fail("textures[" + std::to_string(index) + "].source", "is missing; a PNG or JPEG image is required");
  }
  Texture texture;
  if (source.sampler >= 0) {
    const tinygltf::Sampler& sampler = document.model.samplers.at(static_cast<std::size_t>(source.sampler));
    texture.wrap_u = wrap_mode(document, source.sampler, "wrapS", sampler.wrapS);
    texture.wrap_v = wrap_mode(document, source.sampler, "wrapT", sampler.wrapT);
  }
  std::string field;
  const std::vector<std::uint8_t> bytes = encoded_image(document, source.source, field);
  document.encoded += bytes.size();
  if (document.encoded > kMostEncoded) {
    document.fail(field, "brings the encoded images read to " + std::to_string(document.encoded) + " bytes; " +
                             std::to_string(kMostEncoded) + " are allowed, an image as often as textures name it");
  }
  decode(document, bytes, field, texture);
  return texture;
}

}  // namespace render
