// Flat ink on a sheet: shapes in the sheet's own plane (x right, y up, z toward the reader) as triangles of a mesh.
#pragma once

#include <glm/vec2.hpp>
#include <span>
#include <string_view>

#include "assets/generator/font.hpp"
#include "assets/generator/mesh.hpp"

namespace assets {

// How far ink lies above its sheet. Near a lamp that shines along the sheet ink throws a shadow four times as long as
// its lift, so the near sheets keep it below an arcmin at 0.4 m; single precision resolves 0.1 um there.
inline constexpr double kNearInkLift = 0.00003;  // m
inline constexpr double kFarInkLift = 0.001;     // m

// Contours times scale (metres a unit), their origin at `origin`, at height lift above the plane z = 0.
void add_ink(Mesh& mesh, std::span<const Contour> contours, const glm::dvec2& origin, double scale, double lift);

// An axis-parallel rectangle of ink.
void add_ink_rectangle(Mesh& mesh, const glm::dvec2& low, const glm::dvec2& high, double lift);

// One line of text with its baseline starting at `origin`; em in metres; tolerance: of the flattened curves, metres.
void add_text(Mesh& mesh, const Font& font, std::string_view text, const glm::dvec2& origin, double em, double lift,
              double tolerance);

}  // namespace assets
