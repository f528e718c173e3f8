#include "assets/generator/ink.hpp"

#include <array>

namespace assets {

void add_ink(Mesh& mesh, std::span<const Contour> contours, const glm::dvec2& origin, double scale, double lift) {
  const FlatShape shape = fill(contours);
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const glm::dvec2& point : shape.points) {
    mesh.add_vertex(glm::dvec3(origin + scale * point, lift), {0.0, 0.0, 1.0});
  }
  for (const std::uint32_t index : shape.indices) mesh.indices.push_back(first + index);
}

void add_ink_rectangle(Mesh& mesh, const glm::dvec2& low, const glm::dvec2& high, double lift) {
  add_quad(mesh, {low.x, low.y, lift}, {high.x, low.y, lift}, {high.x, high.y, lift}, {low.x, high.y, lift});
}

void add_text(Mesh& mesh, const Font& font, std::string_view text, const glm::dvec2& origin, double em, double lift,
              double tolerance) {
  double x = 0.0;
  for (const char character : text) {
    const Glyph glyph = font.glyph(character, tolerance / em);
    add_ink(mesh, glyph.contours, origin + glm::dvec2(x * em, 0.0), em, lift);
    x += glyph.advance;
  }
}

}  // namespace assets
