// Glyph outlines of an outline font as contours in units of the em, through FreeType, unhinted and unscaled.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "assets/generator/planar_fill.hpp"

namespace assets {

struct Glyph {
  std::vector<Contour> contours;  // baseline at y = 0
  double advance = 0.0;
};

class Font {
 public:
  // Throws tracking::InputError when the file is no outline font.
  explicit Font(const std::string& path);
  ~Font();
  Font(const Font&) = delete;
  Font& operator=(const Font&) = delete;

  // tolerance: how far a flattened curve may leave the true one, in em.
  [[nodiscard]] Glyph glyph(char character, double tolerance) const;
  // Width in em.
  [[nodiscard]] double width(std::string_view text) const;

 private:
  struct Face;
  std::unique_ptr<Face> face_;
};

}  // namespace assets
