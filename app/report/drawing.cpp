#include "app/report/drawing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/report/html.hpp"
#include "app/report/text.hpp"

namespace app {
namespace {

constexpr int kScale = 2;  // of the bitmap font
constexpr render::Rgb kGround{255, 255, 255};

std::string hex(const render::Rgb& colour) {
  return format("#%02x%02x%02x", colour.r, colour.g, colour.b);
}

void draw_disc(render::Image8& image, render::Point at, double radius, render::Rgb colour) {
  render::draw_line(image, at, at, 2.0 * radius, colour);  // round ends, and nothing between
}

}  // namespace

int drawn_width(const std::string& text) {
  return render::text_width(text, kScale);
}

std::string to_svg(const Drawing& drawing) {
  // Arial and its metric twins are narrower at this size than the bitmap font, so what has room there has it here.
  std::string out = format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\" viewBox=\"0 0 %d %d\" "
      "font-family=\"Arial, Liberation Sans, sans-serif\" font-size=\"18\">\n"
      "<rect width=\"100%%\" height=\"100%%\" fill=\"white\"/>\n",
      drawing.width, drawing.height, drawing.width, drawing.height);
  for (const Drawing::Line& line : drawing.lines) {
    out += format(
        "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"%s\" stroke-width=\"%.1f\" "
        "stroke-linecap=\"round\"/>\n",
        line.from.x, line.from.y, line.to.x, line.to.y, hex(line.colour).c_str(), line.thickness);
  }
  for (const Drawing::Dot& dot : drawing.dots) {
    out += format("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\" ", dot.at.x, dot.at.y, dot.radius) +
           (dot.ring ? "fill=\"none\" stroke-width=\"2\" stroke=\"" : "fill=\"") + hex(dot.colour) + "\"/>\n";
  }
  for (const Drawing::Text& text : drawing.texts) {
    const char* anchor = text.anchor == Drawing::Anchor::left     ? "start"
                         : text.anchor == Drawing::Anchor::middle ? "middle"
                                                                  : "end";
    out += format("<text x=\"%d\" y=\"%d\" text-anchor=\"%s\" fill=\"%s\">", text.x, text.y + kDrawnTextHeight, anchor,
                  hex(text.colour).c_str()) +
           html_escaped(text.text) + "</text>\n";
  }
  return out + "</svg>\n";
}

render::Image8 to_image(const Drawing& drawing) {
  render::Image8 image = render::black_image(drawing.width, drawing.height);
  render::fill_rect(image, {0, 0, drawing.width, drawing.height}, kGround);
  for (const Drawing::Line& line : drawing.lines) {
    render::draw_line(image, line.from, line.to, line.thickness, line.colour);
  }
  for (const Drawing::Dot& dot : drawing.dots) {
    if (!dot.ring) {
      draw_disc(image, dot.at, dot.radius, dot.colour);
      continue;
    }
    constexpr int kSides = 32;
    const auto corner = [&](int i) {
      const double angle = 2.0 * std::numbers::pi * i / kSides;
      return render::Point{dot.at.x + dot.radius * std::cos(angle), dot.at.y + dot.radius * std::sin(angle)};
    };
    for (int i = 0; i < kSides; ++i) {
      render::draw_line(image, corner(i), corner(i + 1), 2.0, dot.colour);
    }
  }
  for (const Drawing::Text& text : drawing.texts) {
    const int width = drawn_width(text.text);
    const int left = text.anchor == Drawing::Anchor::left     ? text.x
                     : text.anchor == Drawing::Anchor::middle ? text.x - width / 2
                                                              : text.x - width;
    render::draw_text(image, left, text.y, kScale, text.text, text.colour);
  }
  return image;
}

}  // namespace app
