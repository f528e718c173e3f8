#include "render/image/draw.hpp"

#include <stb/stb_easy_font.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace render {
namespace {

// The font reads beyond its table for anything but printable ASCII and line ends.
std::string printable(const std::string& text) {
  std::string result;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    const bool continuation = (code & 0xc0U) == 0x80U;  // the later bytes of a UTF-8 character
    if (continuation) continue;
    result += (code >= 32 && code < 127) || c == '\n' ? c : '?';
  }
  return result;
}

struct FontVertex {
  float x, y, z;
  std::uint8_t colour[4];
};
static_assert(sizeof(FontVertex) == 16);

}  // namespace

void shade_rect(Image8& image, const Rect& where, Rgb colour, double opacity) {
  const int x0 = std::clamp(where.x, 0, image.width), x1 = std::clamp(where.x + where.width, x0, image.width);
  const int y0 = std::clamp(where.y, 0, image.height), y1 = std::clamp(where.y + where.height, y0, image.height);
  const double target[3] = {double(colour.r), double(colour.g), double(colour.b)};
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      const std::size_t pixel =
          3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x));
      for (std::size_t c = 0; c < 3; ++c) {
        auto& value = image.rgb[pixel + c];
        value = static_cast<std::uint8_t>(std::lround(value + opacity * (target[c] - value)));
      }
    }
  }
}

void fill_rect(Image8& image, const Rect& where, Rgb colour) {
  shade_rect(image, where, colour, 1.0);
}

void draw_hline(Image8& image, int x, int y, int length, int thickness, Rgb colour) {
  fill_rect(image, {x, y, length, thickness}, colour);
}

void draw_vline(Image8& image, int x, int y, int length, int thickness, Rgb colour) {
  fill_rect(image, {x, y, thickness, length}, colour);
}

void draw_line(Image8& image, Point from, Point to, double thickness, Rgb colour) {
  const double dx = to.x - from.x, dy = to.y - from.y, length2 = dx * dx + dy * dy;
  if (!std::isfinite(length2)) return;
  // Along the longer side, at each pixel only as far across as the line is thick.
  const bool level = std::abs(dx) >= std::abs(dy);
  const double reach = 0.5 * thickness + 1.0, slope = length2 > 0.0 ? (level ? dy / dx : dx / dy) : 0.0;
  const auto pixel = [](double at, int size) { return static_cast<int>(std::clamp(at, 0.0, double(size))); };
  const double low = level ? std::min(from.x, to.x) : std::min(from.y, to.y);
  const double high = level ? std::max(from.x, to.x) : std::max(from.y, to.y);
  const int along_size = level ? image.width : image.height, across_size = level ? image.height : image.width;
  const int last = pixel(high + reach + 1.0, along_size);
  for (int i = pixel(low - reach, along_size); i < last; ++i) {
    const double on_line = std::clamp(i + 0.5, low, high);
    const double middle = level ? from.y + slope * (on_line - from.x) : from.x + slope * (on_line - from.y);
    const int end = pixel(middle + 1.5 * reach + 1.0, across_size);
    for (int k = pixel(middle - 1.5 * reach, across_size); k < end; ++k) {
      const int x = level ? i : k, y = level ? k : i;
      const double px = x + 0.5 - from.x, py = y + 0.5 - from.y;
      const double along = length2 > 0.0 ? std::clamp((px * dx + py * dy) / length2, 0.0, 1.0) : 0.0;
      const double away = std::hypot(px - along * dx, py - along * dy);
      const double cover = std::clamp(0.5 * thickness + 0.5 - away, 0.0, 1.0);
      if (cover > 0.0) shade_rect(image, {x, y, 1, 1}, colour, cover);
    }
  }
}

void draw_text(Image8& image, int x, int y, int scale, const std::string& text, Rgb colour) {
  std::string line = printable(text);
  // No character has more than 16 strokes.
  std::vector<FontVertex> vertices(line.size() * 16 * 4);
  const int quads = stb_easy_font_print(0.0F, 0.0F, line.data(), nullptr, vertices.data(),
                                        static_cast<int>(vertices.size() * sizeof(FontVertex)));
  for (std::size_t quad = 0; quad < static_cast<std::size_t>(quads); ++quad) {
    const FontVertex& top_left = vertices[4 * quad];
    const FontVertex& bottom_right = vertices[4 * quad + 2];
    const int left = static_cast<int>(top_left.x), top = static_cast<int>(top_left.y);
    const int right = static_cast<int>(bottom_right.x), bottom = static_cast<int>(bottom_right.y);
    fill_rect(image, {x + scale * left, y + scale * top, scale * (right - left), scale * (bottom - top)}, colour);
  }
}

int text_width(const std::string& text, int scale) {
  std::string line = printable(text);
  return scale * stb_easy_font_width(line.data());
}

}  // namespace render
