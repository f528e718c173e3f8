// What the corners of smooth tiles (render/lens_forms/tile_cubics.hpp) say of their pixels' rays, worked out in double.
#pragma once

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "render/frame_buffers.hpp"
#include "render/lens_forms/corner_grid.hpp"

namespace support {

// In the eye's primary axes; the direction of unit length.
struct CubicRay {
  glm::dvec3 origin, direction;
};

// Of the first view of a frame that has been drawn; or of none, with no smooth tile.
class CubicPicture {
 public:
  CubicPicture() = default;
  CubicPicture(const render::FrameBuffers& out, int size)
      : across_(render::tile_corner_grid(size, size).count.x),
        tiles_((size + 7) / 8),
        texels_(out.corners.read<glm::vec4>(kTexels * static_cast<std::size_t>(across_ * across_))),
        smooth_(out.smooth_tiles.read<std::uint32_t>(static_cast<std::size_t>(tiles_ * tiles_))) {}

  [[nodiscard]] bool is_smooth(int x, int y) const {
    return !smooth_.empty() && smooth_[static_cast<std::size_t>(y / 8 * tiles_ + x / 8)] != 0;
  }
  [[nodiscard]] std::size_t smooth_tiles() const {
    return static_cast<std::size_t>(std::ranges::count_if(smooth_, [](std::uint32_t word) { return word != 0; }));
  }
  [[nodiscard]] CubicRay at(int x, int y) const {
    const auto across = weights((x % 8 + 0.5) * 3.0 / 8.0), down = weights((y % 8 + 0.5) * 3.0 / 8.0);
    CubicRay sum{glm::dvec3(0.0), glm::dvec3(0.0)};
    for (std::size_t k = 0; k < 16; ++k) {
      const double weight = across[k % 4] * down[k / 4];
      const int corner = (y / 8 * 3 + static_cast<int>(k / 4)) * across_ + x / 8 * 3 + static_cast<int>(k % 4);
      const std::size_t first = kTexels * static_cast<std::size_t>(corner);
      sum.origin += weight * glm::dvec3(texels_[first]);
      sum.direction += weight * glm::dvec3(texels_[first + 1]);
    }
    sum.direction = glm::normalize(sum.direction);
    return sum;
  }

 private:
  static constexpr std::size_t kTexels = render::gpu::kCornerTexels;

  static std::array<double, 4> weights(double t) {
    const double a = t - 1.0, b = t - 2.0, c = t - 3.0;
    return {-a * b * c / 6.0, t * b * c / 2.0, -t * a * c / 2.0, t * a * b / 6.0};
  }

  int across_ = 0, tiles_ = 0;
  std::vector<glm::vec4> texels_;
  std::vector<std::uint32_t> smooth_;
};

}  // namespace support
