// An outline font at one size as pictures of its glyphs, through FreeType; a glyph is drawn once and kept.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace app {

// Coverage, 255 full, row by row from the top.
struct GlyphPicture {
  int left = 0, top = 0;  // px from the pen to its left side, from the base line up to its top
  int width = 0, height = 0;
  double advance = 0.0;  // px to the next pen
  std::vector<std::uint8_t> coverage = {};
};

class PlateFont {
 public:
  // x_height: of the letter x, px. Throws tracking::InputError when the file is no outline font.
  PlateFont(const std::string& path, double x_height);
  ~PlateFont();
  PlateFont(PlateFont&&) noexcept;
  PlateFont& operator=(PlateFont&&) = delete;

  // What the font lacks is its mark for a missing glyph.
  [[nodiscard]] const GlyphPicture& glyph(char32_t character) const;
  [[nodiscard]] double width(std::u32string_view text) const;  // px

 private:
  struct Face;
  std::unique_ptr<Face> face_;
};

}  // namespace app
