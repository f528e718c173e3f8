// What nobody sees of a view: the parts of a headset's display that its lenses hide. As an area in front of the eye,
// and as pixels of a picture.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tracking/stereo_view.hpp"

namespace tracking {

// Corners on the view's plane z = -1: tangents to the right and up of its axis.
using TangentTriangle = std::array<glm::dvec2, 3>;

// Triangles in any order, turned either way, that may overlap; none: everything is seen.
struct HiddenArea {
  std::vector<TangentTriangle> triangles;
};

// Pixels row by row from the upper left; 1: hidden.
struct PixelMask {
  int width = 0, height = 0;
  std::vector<std::uint8_t> hidden;

  [[nodiscard]] bool at(int x, int y) const {
    return hidden[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] != 0;
  }
  // Of all pixels, 0 to 1; of none, 0.
  [[nodiscard]] double hidden_fraction() const;
};

// The area and all that lies outside a field of view besides: for pictures that show more than is seen of them.
[[nodiscard]] HiddenArea with_outside(HiddenArea area, const FieldOfView& fov);

// A pixel is hidden only where its whole square is.
[[nodiscard]] PixelMask hidden_pixels(const HiddenArea& area, const FieldOfView& fov, int width, int height);

// What stays hidden with a band of `pixels` kept around all that is seen (in any direction, by the greater of columns
// and rows). Nothing beyond the picture's border is seen.
[[nodiscard]] PixelMask shrunk(const PixelMask& mask, int pixels);

}  // namespace tracking
