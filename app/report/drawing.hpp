// A picture of lines, dots and words, written as SVG or drawn into an image: the same in both.
#pragma once

#include <string>
#include <vector>

#include "render/image/draw.hpp"
#include "render/image/image.hpp"

namespace app {

struct Drawing {
  enum class Anchor { left, middle, right };  // which point of a text its x is
  struct Line {
    render::Point from, to;
    double thickness = 1.0;
    render::Rgb colour = {};
  };
  struct Dot {
    render::Point at;
    double radius = 4.0;
    render::Rgb colour = {};
    bool ring = false;  // not filled
  };
  struct Text {
    int x = 0, y = 0;  // y: top of the letters
    std::string text = {};
    render::Rgb colour = {};
    Anchor anchor = Anchor::left;
  };

  int width = 0, height = 0;
  // Lines lie below dots, dots below texts.
  std::vector<Line> lines = {};
  std::vector<Dot> dots = {};
  std::vector<Text> texts = {};
};

constexpr int kDrawnTextHeight = 14;  // px, of capitals
[[nodiscard]] int drawn_width(const std::string& text);

[[nodiscard]] std::string to_svg(const Drawing& drawing);
[[nodiscard]] render::Image8 to_image(const Drawing& drawing);

}  // namespace app
