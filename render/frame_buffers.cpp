#include "render/frame_buffers.hpp"

#include <glm/packing.hpp>
#include <glm/vec4.hpp>

namespace render {

RenderedView read_view(const FrameBuffers& frame, const FrameConfig& config, std::size_t index) {
  const std::size_t count = static_cast<std::size_t>(config.width) * static_cast<std::size_t>(config.height);
  RenderedView view;
  view.display = {config.width, config.height, std::vector<std::uint8_t>(3 * count)};
  const auto shown = frame.display.read<std::uint32_t>(count, index * count * 4);
  for (std::size_t i = 0; i < count; ++i) {
    view.display.rgb[3 * i] = static_cast<std::uint8_t>(shown[i] & 255U);
    view.display.rgb[3 * i + 1] = static_cast<std::uint8_t>((shown[i] >> 8U) & 255U);
    view.display.rgb[3 * i + 2] = static_cast<std::uint8_t>((shown[i] >> 16U) & 255U);
  }
  if (config.keep_radiance) {
    view.radiance.resize(3 * count);
    const auto packed = frame.radiance.read<glm::uvec2>(count, index * count * 8);
    for (std::size_t i = 0; i < count; ++i) {
      const glm::vec2 rg = glm::unpackHalf2x16(packed[i].x);
      view.radiance[3 * i] = rg.x;
      view.radiance[3 * i + 1] = rg.y;
      view.radiance[3 * i + 2] = glm::unpackHalf2x16(packed[i].y).x;
    }
  }
  if (config.keep_wavefront) {
    const auto wavefronts = frame.wavefronts.read<glm::vec4>(2 * count, index * count * kWavefrontBytes);
    WavefrontPlanes& planes = view.wavefront;
    for (std::size_t i = 0; i < count; ++i) {
      const glm::vec4& v = wavefronts[2 * i];
      const glm::vec4& more = wavefronts[2 * i + 1];
      planes.v_hh.push_back(v.x);
      planes.v_hv.push_back(v.y);
      planes.v_vv.push_back(v.z);
      planes.accommodation.push_back(v.w);
      planes.blur.push_back(more.x);
      planes.depth.push_back(more.y);
    }
  }
  return view;
}

}  // namespace render
