// Views laid out as one picture: the eyes side by side, and in each eye pair A left and pair B right of a divider.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "render/renderer.hpp"

namespace app {

struct PictureLayout {
  int width = 0, height = 0;  // of a view
  std::size_t pairs = 1;      // 1, or 2 for A against B
  std::size_t sides = 1;
  [[nodiscard]] int picture_width() const { return width * static_cast<int>(sides); }
};

// The view (pair by pair, then side) that a column of the picture shows, and the column within it.
struct PictureColumn {
  std::size_t view;
  int x;
  bool divider;  // the line between A and B
};

[[nodiscard]] PictureColumn picture_column(const PictureLayout& layout, int x);

[[nodiscard]] render::Image8 compose_display(const PictureLayout& layout, const render::RenderedFrame& frame);

// R, G, B in linear light, without exposure; with `all` also depth, V.hh, V.hv, V.vv, blur, accommodation.
[[nodiscard]] render::FloatImage compose_channels(const PictureLayout& layout, const render::RenderedFrame& frame,
                                                  bool all);

}  // namespace app
