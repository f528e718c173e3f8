#include "render/image/colour_bar.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "render/image/gpu/colour_map.h"

namespace render {
namespace {

int text_scale(const Image8& image) {
  return std::max(1, image.height / 480);
}

// The smallest of 1, 2, 5 times a power of ten that fits the range into at_most ticks.
double round_step(double range, int at_most) {
  const double least = range / std::max(1, at_most - 1);
  const double decade = std::pow(10.0, std::floor(std::log10(least)));
  // The slack keeps a step that fits exactly from being passed over for its last bit.
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * decade >= least * (1.0 - 1e-9)) return factor * decade;
  }
  return 10.0 * decade;
}

std::string number(double value, double step) {
  const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
  char text[64];
  if (decimals > 4 || std::abs(value) >= 1e6) {
    std::snprintf(text, sizeof text, "%.4g", value);
  } else {
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
  }
  return text;
}

// Broken between words into lines of at most `width` pixels; a longer word stays whole.
std::vector<std::string> wrapped(const std::string& text, int width, int scale) {
  std::vector<std::string> lines;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (!lines.empty() && text_width(lines.back() + " " + word, scale) <= width) {
      lines.back() += " " + word;
    } else {
      lines.push_back(word);
    }
  }
  return lines;
}

void draw_colours(Image8& image, const Rect& bar, int which_map) {
  for (int row = 0; row < bar.height; ++row) {
    const float x = 1.0F - static_cast<float>(row) / static_cast<float>(std::max(1, bar.height - 1));
    const glm::vec3 colour = 255.0F * gpu::colour_map(which_map, x);
    const auto step = [](float value) { return static_cast<std::uint8_t>(std::lround(value)); };
    draw_hline(image, bar.x, bar.y + row, bar.width, 1, {step(colour.r), step(colour.g), step(colour.b)});
  }
}

void draw_ticks(Image8& image, const Rect& bar, double lo, double hi, int scale, Rgb colour) {
  const int at_most = std::max(2, bar.height / (2 * kLineHeight * scale));
  for (const Tick& tick : round_ticks(lo, hi, at_most)) {
    const int y = bar.y + static_cast<int>(std::lround((hi - tick.value) / (hi - lo) * (bar.height - 1)));
    const int right = bar.x + bar.width;
    draw_hline(image, right, y - scale / 2, 3 * scale, scale, colour);
    draw_text(image, right + 8 * scale, y - kTextHeight * scale / 2, scale, tick.label, colour);
  }
}

}  // namespace

std::vector<Tick> round_ticks(double lo, double hi, int at_most) {
  if (!(hi > lo) || !std::isfinite(hi - lo) || at_most < 1) return {};
  const double step = round_step(hi - lo, at_most);
  std::vector<Tick> ticks;
  const double first = std::ceil(lo / step - 1e-9), last = std::floor(hi / step + 1e-9);
  for (int i = 0; first + i <= last && i < at_most; ++i) {
    const double value = (first + i) * step + 0.0;  // + 0.0: no negative zero
    ticks.push_back({value, number(value, step)});
  }
  return ticks;
}

Rect colour_bar_place(const Image8& image) {
  const int scale = text_scale(image);
  const int width = 84 * scale, margin = 6 * scale;
  return {image.width - width - margin, margin, width, image.height - 2 * margin};
}

void draw_colour_bar(Image8& image, const Rect& where, int which_map, double lo, double hi, const std::string& unit,
                     const std::string& title, const ColourBarStyle& style) {
  check_image(image);
  if (image.height < kLowestWithColourBar) return;
  const int scale = style.scale > 0 ? style.scale : text_scale(image), margin = 5 * scale;
  shade_rect(image, where, style.ground, style.opacity);

  const auto lines = wrapped(unit.empty() ? title : title + " (" + unit + ")", where.width - 2 * margin, scale);
  int y = where.y + margin;
  for (const std::string& line : lines) {
    draw_text(image, where.x + margin, y, scale, line, style.text);
    y += kLineHeight * scale;
  }
  // Half a line free at both ends, where the outermost numbers reach beyond the bar.
  y += kTextHeight * scale / 2;
  const Rect bar{where.x + margin, y, 16 * scale, where.y + where.height - margin - kTextHeight * scale / 2 - y};
  if (bar.height <= 0) return;
  draw_colours(image, bar, which_map);
  draw_ticks(image, bar, lo, hi, scale, style.text);
}

}  // namespace render
