// Corners of squares of a picture, whose rays through the lens stand for those of the pixels between them
// (shaders/corners.comp.glsl, shaders/between.comp.glsl): on a grid of pixels traced anew for every frame, or as a
// field over the view that is kept while eye, lens and picture stay as they are (Kakimoto et al. 2007, 2010).
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "render/accuracy.hpp"
#include "render/frame_types.hpp"

namespace render {

struct CornerGrid {
  glm::dvec2 spacing{0.0};  // pixels
  glm::ivec2 count{0};      // none where the lens is not interpolated

  [[nodiscard]] std::size_t rays() const {
    return static_cast<std::size_t>(count.x) * static_cast<std::size_t>(count.y);
  }
};

[[nodiscard]] CornerGrid corner_grid(const LensAccuracy& lens, int width, int height);

// A corner every 8/3 pixels, from the edge of one tile of 8 x 8 pixels to the next.
[[nodiscard]] CornerGrid tile_corner_grid(int width, int height);

// All that the rays at a field's corners depend on: two frames with the same key have the same field.
[[nodiscard]] std::vector<std::byte> corner_key(const LensAccuracy& lens, const CornerGrid& grid,
                                                const std::vector<gpu::ViewData>& views,
                                                const std::vector<glm::vec4>& table);

}  // namespace render
