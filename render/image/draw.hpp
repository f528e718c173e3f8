// Lines, boxes and text in a picture. What lies outside the picture is cut off.
#pragma once

#include <cstdint>
#include <string>

#include "render/image/image.hpp"

namespace render {

struct Rgb {
  std::uint8_t r = 0, g = 0, b = 0;
};

struct Rect {
  int x = 0, y = 0, width = 0, height = 0;  // top left corner, pixels
};

void fill_rect(Image8& image, const Rect& where, Rgb colour);
// Mixes towards the colour; 0 leaves the picture, 1 covers it.
void shade_rect(Image8& image, const Rect& where, Rgb colour, double opacity);
void draw_hline(Image8& image, int x, int y, int length, int thickness, Rgb colour);
void draw_vline(Image8& image, int x, int y, int length, int thickness, Rgb colour);

// From one point to another (pixels, the middle of the first one at 0.5), with round ends and soft edges.
struct Point {
  double x = 0.0, y = 0.0;
};
void draw_line(Image8& image, Point from, Point to, double thickness, Rgb colour);

// A bitmap font of 7 pixels' height a scale step, 12 from line to line; ASCII, anything else shows as '?'.
void draw_text(Image8& image, int x, int y, int scale, const std::string& text, Rgb colour);
[[nodiscard]] int text_width(const std::string& text, int scale);
constexpr int kTextHeight = 7, kLineHeight = 12;

}  // namespace render
