// Optotypes on a 5 x 5 grid of strokes: the ten Sloan letters (NAS-NRC Committee on Vision 1980: five strokes high and
// wide, stroke a fifth) and the Landolt ring (ISO 8596: gap = stroke = a fifth of the outer diameter).
#pragma once

#include <string_view>
#include <vector>

#include "assets/generator/planar_fill.hpp"

namespace assets {

inline constexpr std::string_view kSloanLetters = "CDHKNORSVZ";

// Contours in strokes, from (0, 0) to (5, 5).
[[nodiscard]] std::vector<Contour> sloan_letter(char letter);

// Contours in strokes about the centre (0, 0); the gap lies in the direction gap_angle (radians from +x).
[[nodiscard]] std::vector<Contour> landolt_ring(double gap_angle);

// Height of a letter of the given logMAR at a distance (m): 5 * 10^logmar arcmin, as the tangent of the whole angle.
[[nodiscard]] double letter_height(double logmar, double distance);

}  // namespace assets
