#include "app/notice/plate_font.hpp"

#include <ft2build.h>
#include FT_FREETYPE_H

#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <unordered_map>

#include "tracking/input_error.hpp"

namespace app {

struct PlateFont::Face {
  FT_Library library = nullptr;
  FT_Face face = nullptr;
  std::unordered_map<char32_t, GlyphPicture> drawn;

  explicit Face(const std::string& path) {
    if (FT_Init_FreeType(&library) != 0) throw std::runtime_error("FreeType does not start");
    if (FT_New_Face(library, path.c_str(), 0, &face) != 0 || FT_IS_SCALABLE(face) == 0) {
      FT_Done_FreeType(library);
      throw tracking::InputError(path, "", "not a readable outline font; a TrueType or OpenType font is allowed");
    }
  }
  ~Face() { FT_Done_FreeType(library); }  // takes its faces with it
  Face(const Face&) = delete;
  Face& operator=(const Face&) = delete;
};

namespace {

constexpr double kSixtyFourths = 64.0;  // FreeType's 26.6 numbers

GlyphPicture picture_of(const FT_GlyphSlot slot) {
  const FT_Bitmap& bitmap = slot->bitmap;
  GlyphPicture picture{.left = slot->bitmap_left,
                       .top = slot->bitmap_top,
                       .width = static_cast<int>(bitmap.width),
                       .height = static_cast<int>(bitmap.rows),
                       .advance = static_cast<double>(slot->advance.x) / kSixtyFourths};
  for (unsigned row = 0; row < bitmap.rows; ++row) {
    const unsigned char* from = bitmap.buffer + static_cast<std::ptrdiff_t>(row) * bitmap.pitch;
    picture.coverage.insert(picture.coverage.end(), from, from + bitmap.width);
  }
  return picture;
}

}  // namespace

PlateFont::PlateFont(const std::string& path, double x_height) : face_(std::make_unique<Face>(path)) {
  const FT_Face face = face_->face;
  double x_in_em = 0.5;  // for a font without the letter
  if (FT_Load_Char(face, 'x', FT_LOAD_NO_SCALE) == 0 && face->glyph->metrics.height > 0) {
    x_in_em = static_cast<double>(face->glyph->metrics.height) / face->units_per_EM;
  }
  FT_Set_Char_Size(face, 0, std::lround(kSixtyFourths * x_height / x_in_em), 72, 72);  // at 72 dpi a point is a pixel
}
PlateFont::~PlateFont() = default;
PlateFont::PlateFont(PlateFont&&) noexcept = default;

const GlyphPicture& PlateFont::glyph(char32_t character) const {
  const auto found = face_->drawn.find(character);
  if (found != face_->drawn.end()) {
    return found->second;
  }
  // Unhinted: the compositor resamples it anyway.
  const bool there = FT_Load_Char(face_->face, character, FT_LOAD_RENDER | FT_LOAD_NO_HINTING) == 0;
  return face_->drawn.emplace(character, there ? picture_of(face_->face->glyph) : GlyphPicture{}).first->second;
}

double PlateFont::width(std::u32string_view text) const {
  double width = 0.0;
  for (const char32_t character : text) {
    width += glyph(character).advance;
  }
  return width;
}

}  // namespace app
