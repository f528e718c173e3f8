#include "app/notice/plate.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/notice/utf8.hpp"
#include "render/image/srgb.hpp"

namespace app {
namespace {

using Kind = PlateLine::Kind;

// In heights of the letter x.
constexpr double kLineStep = 2.5, kMargin = 1.6, kColumnGap = 1.5, kBeforeHeading = 0.8, kCorner = 1.4;
constexpr int kBorder = PlatePicture::kBorder;
constexpr double kAscent = 1.45;  // from a line's top to its base line: capitals, and room for their accents

struct Ink {
  std::uint8_t r, g, b;  // display-encoded
};
constexpr Ink kGround{14, 18, 24}, kQuiet{142, 164, 190}, kText{232, 234, 236}, kHeading{142, 190, 236},
    kWarning{255, 190, 92};

using Pixel = Plate::Pixel;
using Ramp = Plate::Ramp;

std::uint8_t mixed(std::uint8_t ground, std::uint8_t ink, double opacity, double coverage) {
  const double light = (1.0 - coverage) * opacity * render::srgb_decode(ground) + coverage * render::srgb_decode(ink);
  return render::srgb_encode(static_cast<float>(light));
}

Pixel pixel(Ink ink, double opacity, double coverage) {
  const double alpha = opacity + (1.0 - opacity) * coverage;
  return {mixed(kGround.r, ink.r, opacity, coverage), mixed(kGround.g, ink.g, opacity, coverage),
          mixed(kGround.b, ink.b, opacity, coverage), static_cast<std::uint8_t>(std::lround(255.0 * alpha))};
}

Ramp ramp_of(Ink ink, double opacity) {
  Ramp ramp;
  for (std::size_t i = 0; i < ramp.size(); ++i) {
    ramp[i] = pixel(ink, opacity, static_cast<double>(i) / 255.0);
  }
  return ramp;
}

void set(PlatePicture& picture, int x, int y, const Pixel& value) {
  const auto at = 4 * (static_cast<std::ptrdiff_t>(y) * picture.width + x);
  std::ranges::copy(value, picture.rgba.begin() + at);
}

void draw_glyph(PlatePicture& picture, const GlyphPicture& glyph, int x, int y, const Ramp& ramp) {
  for (int row = 0; row < glyph.height; ++row) {
    for (int column = 0; column < glyph.width; ++column) {
      const int px = x + glyph.left + column, py = y - glyph.top + row;
      const Pixel& ink = ramp[glyph.coverage[static_cast<std::size_t>(row * glyph.width + column)]];
      const bool inside = px >= 0 && px < picture.width && py >= 0 && py < picture.height;
      // Where two letters overlap, the one that covers more.
      if (inside && ink[3] >= picture.rgba[4 * static_cast<std::size_t>(py * picture.width + px) + 3]) {
        set(picture, px, py, ink);
      }
    }
  }
}

// width, height: of the plate within its border.
PlatePicture ground(int width, int height, double corner, double opacity) {
  PlatePicture picture{.width = width + 2 * kBorder, .height = height + 2 * kBorder};
  picture.rgba.resize(4 * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
  const Pixel plate = pixel(kGround, opacity, 0.0);
  std::vector<std::uint8_t> row;
  for (int x = 0; x < width; ++x) {
    row.insert(row.end(), plate.begin(), plate.end());
  }
  for (int y = kBorder; y < kBorder + height; ++y) {
    std::ranges::copy(row, picture.rgba.begin() + 4 * (static_cast<std::ptrdiff_t>(y) * picture.width + kBorder));
  }
  const int size = static_cast<int>(std::ceil(corner));
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const double outside = std::hypot(corner - x - 0.5, corner - y - 0.5) - corner;
      if (outside > -0.5) {
        const Pixel edge = pixel(kGround, std::clamp(0.5 - outside, 0.0, 1.0) * opacity, 0.0);
        for (const int px : {kBorder + x, kBorder + width - 1 - x}) {
          set(picture, px, kBorder + y, edge);
          set(picture, px, kBorder + height - 1 - y, edge);
        }
      }
    }
  }
  return picture;
}

}  // namespace

struct Plate::Row {
  double x = 0.0, top = 0.0;  // px
  std::u32string text;
  Kind kind = Kind::plain;
  bool is_label = false;
};

Plate::Plate(const PlateConfig& config)
    : config_(config),
      plain_(config.font, config.x_height),
      bold_(config.bold_font, config.x_height),
      inks_{ramp_of(kText, config.opacity), ramp_of(kHeading, config.opacity), ramp_of(kWarning, config.opacity),
            ramp_of(kQuiet, config.opacity)} {}

const PlateFont& Plate::font_of(Kind kind) const {
  return kind == Kind::heading ? bold_ : plain_;
}

// At spaces; within a word only where it alone is wider than the column.
std::vector<std::u32string> Plate::broken(const std::string& text, const PlateFont& font, double width) const {
  std::vector<std::u32string> rows;
  std::u32string rest = drawn_characters(text);
  while (!rest.empty()) {
    std::size_t fits = 0, at_space = 0;
    for (double used = 0.0; fits < rest.size(); ++fits) {
      used += font.glyph(rest[fits]).advance;
      if (used > width && rest[fits] != U' ') {
        break;
      }
      if (rest[fits] == U' ') {
        at_space = fits + 1;
      }
    }
    const std::size_t cut = fits == rest.size() ? fits : at_space > 0 ? at_space : std::max<std::size_t>(fits, 1);
    std::u32string row = rest.substr(0, cut);
    rest.erase(0, cut);
    row.erase(row.find_last_not_of(U' ') + 1);
    if (static_cast<int>(rows.size()) + 1 == config_.most_rows && !rest.empty()) {
      constexpr char32_t kEllipsis = 0x2026;
      while (!row.empty() && font.width(row) + font.glyph(kEllipsis).advance > width) {
        row.pop_back();
      }
      row += kEllipsis;
      rest.clear();
    }
    rows.push_back(std::move(row));
  }
  if (rows.empty()) {
    rows.emplace_back();
  }
  return rows;
}

double Plate::label_column(const std::vector<PlateLine>& lines) const {
  double widest = 0.0;
  for (const PlateLine& line : lines) {
    widest = std::max(widest, plain_.width(drawn_characters(line.label)));
  }
  return widest > 0.0 ? widest + kColumnGap * config_.x_height : 0.0;
}

std::vector<Plate::Row> Plate::laid_out(const std::vector<PlateLine>& lines) const {
  const double x = config_.x_height, margin = kMargin * x, column = label_column(lines);
  std::vector<Row> rows;
  double top = margin;
  for (const PlateLine& line : lines) {
    const bool in_column = !line.label.empty();
    const double left = margin + (in_column ? column : 0.0);
    if (line.kind == Kind::heading && !rows.empty()) {
      top += kBeforeHeading * x;
    }
    if (in_column) {
      rows.push_back({margin, top, drawn_characters(line.label), line.kind, true});
    }
    for (std::u32string& text :
         broken(line.text, font_of(line.kind), config_.most_width - 2 * kBorder - margin - left)) {
      rows.push_back({left, top, std::move(text), line.kind, false});
      top += kLineStep * x;
    }
  }
  std::erase_if(rows, [&](const Row& row) { return row.top + kLineStep * x + margin > config_.most_height; });
  return rows;
}

PlatePicture Plate::draw(const std::vector<PlateLine>& lines) const {
  const double x = config_.x_height, margin = kMargin * x;
  const std::vector<Row> rows = laid_out(lines);
  double right = 2.0 * kCorner * x, bottom = right;  // room for the corners
  for (const Row& row : rows) {
    right = std::max(right, row.x + font_of(row.kind).width(row.text));
    bottom = std::max(bottom, row.top + kLineStep * x);
  }
  const int width = std::min(config_.most_width - 2 * kBorder, static_cast<int>(std::ceil(right + margin)));
  const int height =
      std::min(config_.most_height - 2 * kBorder, static_cast<int>(std::ceil(bottom + margin - 0.9 * x)));
  PlatePicture picture = ground(width, height, kCorner * x, config_.opacity);
  for (const Row& row : rows) {
    const Kind kind = row.is_label && row.kind == Kind::plain ? Kind::quiet : row.kind;
    const Ramp& ramp = inks_[static_cast<std::size_t>(kind)];
    const PlateFont& font = row.is_label ? plain_ : font_of(row.kind);
    double pen = row.x;
    for (const char32_t character : row.text) {
      const GlyphPicture& glyph = font.glyph(character);
      draw_glyph(picture, glyph, kBorder + static_cast<int>(std::lround(pen)),
                 kBorder + static_cast<int>(std::lround(row.top + kAscent * x)), ramp);
      pen += glyph.advance;
    }
  }
  return picture;
}

}  // namespace app
