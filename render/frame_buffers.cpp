#include "render/frame_buffers.hpp"

#include <glm/packing.hpp>
#include <glm/vec4.hpp>

namespace render {

namespace {

std::size_t pixels_of(const FrameConfig& config) {
  return static_cast<std::size_t>(config.width) * static_cast<std::size_t>(config.height);
}

}  // namespace

Image8 read_display(const vk::Buffer& display, const FrameConfig& config, std::size_t index) {
  const std::size_t count = pixels_of(config);
  Image8 image{config.width, config.height, std::vector<std::uint8_t>(3 * count)};
  const auto shown = display.read<std::uint32_t>(count, index * count * 4);
  for (std::size_t i = 0; i < count; ++i) {
    image.rgb[3 * i] = static_cast<std::uint8_t>(shown[i] & 255U);
    image.rgb[3 * i + 1] = static_cast<std::uint8_t>((shown[i] >> 8U) & 255U);
    image.rgb[3 * i + 2] = static_cast<std::uint8_t>((shown[i] >> 16U) & 255U);
  }
  return image;
}

std::vector<float> read_radiance(const vk::Buffer& radiance, const FrameConfig& config, std::size_t index) {
  const std::size_t count = pixels_of(config);
  std::vector<float> values(3 * count);
  const auto packed = radiance.read<glm::uvec2>(count, index * count * 8);
  for (std::size_t i = 0; i < count; ++i) {
    const glm::vec2 rg = glm::unpackHalf2x16(packed[i].x);
    values[3 * i] = rg.x;
    values[3 * i + 1] = rg.y;
    values[3 * i + 2] = glm::unpackHalf2x16(packed[i].y).x;
  }
  return values;
}

WavefrontPlanes read_wavefronts(const vk::Buffer& wavefronts, const FrameConfig& config, std::size_t index) {
  const std::size_t count = pixels_of(config);
  const auto values = wavefronts.read<glm::vec4>(2 * count, index * count * kWavefrontBytes);
  WavefrontPlanes planes;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::vec4& v = values[2 * i];
    const glm::vec4& more = values[2 * i + 1];
    planes.v_hh.push_back(v.x);
    planes.v_hv.push_back(v.y);
    planes.v_vv.push_back(v.z);
    planes.accommodation.push_back(v.w);
    planes.blur.push_back(more.x);
    planes.depth.push_back(more.y);
  }
  return planes;
}

RenderedView read_view(const FrameBuffers& frame, const FrameConfig& config, std::size_t index) {
  RenderedView view;
  view.display = read_display(frame.display, config, index);
  if (config.keep_radiance) {
    view.radiance = read_radiance(frame.radiance, config, index);
  }
  if (config.keep_wavefront) {
    view.wavefront = read_wavefronts(frame.wavefronts, config, index);
  }
  return view;
}

}  // namespace render
