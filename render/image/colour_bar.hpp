// The legend of a map: a bar of its colours with ticks, numbers, unit and title, inside the picture.
#pragma once

#include <string>
#include <vector>

#include "render/image/draw.hpp"

namespace render {

// Pictures lower than this have no room for a legend.
constexpr int kLowestWithColourBar = 160;

struct Tick {
  double value;
  std::string label;
};

// Round numbers (1, 2 or 5 times a power of ten apart) within lo..hi, at most `at_most` and at least 2 where the range
// allows; labels with as many decimals as the distance needs. Nothing for an empty or infinite range.
[[nodiscard]] std::vector<Tick> round_ticks(double lo, double hi, int at_most);

// A place at the right edge, as wide as the labels need.
[[nodiscard]] Rect colour_bar_place(const Image8& image);

struct ColourBarStyle {
  Rgb text{255, 255, 255}, ground{16, 16, 16};
  double opacity = 0.75;  // of the ground
  int scale = 0;          // of the text; 0: by the picture's height
};

// which_map as in gpu/colour_map.h; lo at the foot, hi at the top. Fills `where`; draws nothing in pictures lower than
// kLowestWithColourBar.
void draw_colour_bar(Image8& image, const Rect& where, int which_map, double lo, double hi, const std::string& unit,
                     const std::string& title, const ColourBarStyle& style = {});

}  // namespace render
