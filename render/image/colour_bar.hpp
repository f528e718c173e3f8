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

// which_map as in gpu/colour_map.h; lo at the foot, hi at the top. White text on a dark ground over `where`, sized with
// the picture; draws nothing in pictures lower than kLowestWithColourBar.
void draw_colour_bar(Image8& image, const Rect& where, int which_map, double lo, double hi, const std::string& unit,
                     const std::string& title);

}  // namespace render
