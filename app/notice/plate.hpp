// Lines of text on a dark translucent plate, as the pixels of a panel in the headset.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "app/notice/plate_font.hpp"

namespace app {

// A row of a table: a label in its own column, or a text alone across both.
struct PlateLine {
  enum class Kind { plain, heading, warning, quiet };

  std::string label = {}, text = {};  // UTF-8
  Kind kind = Kind::plain;
  bool operator==(const PlateLine&) const = default;
};

// Red, green, blue, opacity, display-encoded after being multiplied by the opacity in linear light, as a compositor
// takes them from an image of an sRGB format; top row first. Around the plate are kBorder transparent pixels, so that
// its edge stays smooth and alone when it is resampled.
struct PlatePicture {
  static constexpr int kBorder = 2;

  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba = {};
};

struct PlateConfig {
  std::string font, bold_font;  // files
  double x_height = 18.0;       // px
  int most_width = 1024, most_height = 1280;
  int most_rows = 3;  // that one line's text is broken into
  double opacity = 0.9;
};

class Plate {
 public:
  using Pixel = std::array<std::uint8_t, 4>;
  using Ramp = std::array<Pixel, 256>;  // a letter's pixel by how much of it the letter covers

  explicit Plate(const PlateConfig& config);

  // As wide and high as the text asks for, within the most allowed: long texts are broken and end in an ellipsis, rows
  // below the most height are left out.
  [[nodiscard]] PlatePicture draw(const std::vector<PlateLine>& lines) const;

  [[nodiscard]] const PlateConfig& config() const { return config_; }

 private:
  struct Row;
  [[nodiscard]] std::vector<std::u32string> broken(const std::string& text, const PlateFont& font, double width) const;
  [[nodiscard]] std::vector<Row> laid_out(const std::vector<PlateLine>& lines) const;
  [[nodiscard]] double label_column(const std::vector<PlateLine>& lines) const;
  [[nodiscard]] const PlateFont& font_of(PlateLine::Kind kind) const;

  PlateConfig config_;
  PlateFont plain_, bold_;
  std::array<Ramp, 4> inks_;  // by PlateLine::Kind
};

}  // namespace app
