#include "assets/generator/font.hpp"

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "tracking/input_error.hpp"

namespace assets {

struct Font::Face {
  FT_Library library = nullptr;
  FT_Face face = nullptr;

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

  [[nodiscard]] FT_GlyphSlot load(char character) const {
    if (FT_Load_Char(face, static_cast<unsigned char>(character), FT_LOAD_NO_SCALE) != 0) {
      throw std::runtime_error(std::string("the font has no glyph for ") + character);
    }
    return face->glyph;
  }
  [[nodiscard]] double em() const { return face->units_per_EM; }
};

namespace {

// Collects FreeType's outline callbacks.
struct Flattener {
  double em;
  double tolerance;
  std::vector<Contour> contours;

  [[nodiscard]] glm::dvec2 point(const FT_Vector* v) const {
    return glm::dvec2(static_cast<double>(v->x), static_cast<double>(v->y)) / em;
  }
  // A quadratic arc cut into n equal parameter steps leaves its chords by |a - 2b + c| / (4 n^2).
  void quadratic(const glm::dvec2& b, const glm::dvec2& c) {
    const glm::dvec2 a = contours.back().back();
    const double bend = glm::length(a - 2.0 * b + c) / 4.0;
    const int steps = std::max(1, static_cast<int>(std::ceil(std::sqrt(bend / tolerance))));
    for (int i = 1; i <= steps; ++i) {
      const double t = static_cast<double>(i) / steps, s = 1.0 - t;
      contours.back().push_back(s * s * a + 2.0 * s * t * b + t * t * c);
    }
  }
  void cubic(const glm::dvec2& b, const glm::dvec2& c, const glm::dvec2& d) {
    const glm::dvec2 a = contours.back().back();
    const double bend = std::max(glm::length(a - 2.0 * b + c), glm::length(b - 2.0 * c + d)) * 0.75;
    const int steps = std::max(1, static_cast<int>(std::ceil(std::sqrt(bend / tolerance))));
    for (int i = 1; i <= steps; ++i) {
      const double t = static_cast<double>(i) / steps, s = 1.0 - t;
      contours.back().push_back(s * s * s * a + 3.0 * s * s * t * b + 3.0 * s * t * t * c + t * t * t * d);
    }
  }
};

Flattener& flattener(void* user) {
  return *static_cast<Flattener*>(user);
}

int move_to(const FT_Vector* to, void* user) {
  flattener(user).contours.push_back({flattener(user).point(to)});
  return 0;
}
int line_to(const FT_Vector* to, void* user) {
  flattener(user).contours.back().push_back(flattener(user).point(to));
  return 0;
}
int conic_to(const FT_Vector* control, const FT_Vector* to, void* user) {
  flattener(user).quadratic(flattener(user).point(control), flattener(user).point(to));
  return 0;
}
int cubic_to(const FT_Vector* first, const FT_Vector* second, const FT_Vector* to, void* user) {
  Flattener& f = flattener(user);
  f.cubic(f.point(first), f.point(second), f.point(to));
  return 0;
}

}  // namespace

Font::Font(const std::string& path) : face_(std::make_unique<Face>(path)) {}
Font::~Font() = default;

Glyph Font::glyph(char character, double tolerance) const {
  const FT_GlyphSlot slot = face_->load(character);
  Flattener result{face_->em(), tolerance, {}};
  const FT_Outline_Funcs callbacks{move_to, line_to, conic_to, cubic_to, 0, 0};
  if (FT_Outline_Decompose(&slot->outline, &callbacks, &result) != 0) {
    throw std::runtime_error(std::string("the outline is broken for ") + character);
  }
  return {std::move(result.contours), static_cast<double>(slot->metrics.horiAdvance) / face_->em()};
}

double Font::width(std::string_view text) const {
  double width = 0.0;
  for (const char character : text) {
    width += static_cast<double>(face_->load(character)->metrics.horiAdvance) / face_->em();
  }
  return width;
}

}  // namespace assets
