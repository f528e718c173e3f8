// What is wrong with a lens: whether it could be ground, cut, worn, and traced as it is meant.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lenses/lens.hpp"

namespace lenses {

struct LensCheckLimits {
  // m; absent: 0.8 mm, for a contact lens 0.03 mm; the edge of a lens without an outline, which is still to be cut, 0.5
  // mm
  std::optional<double> least_edge = {}, least_centre = {};
  // D: how far the power of a spline may be off the smooth surface that its net stands for.
  double coarse_net = 0.125;
  double entrance_pupil_depth = 0.00305, centre_of_rotation_depth = 0.0135;  // of the eye behind it, m
};

enum class LensFault {
  surfaces_cross,  // inside the outline
  surface_ends,    // inside the outline
  edge_too_thin,
  glass_too_thin,     // within the edge
  net_too_coarse,     // for its curvature
  outline_too_large,  // for the diameter
  outline_crosses_itself,
  touches_eye,
  touches_face,   // brow or cheek
  point_outside,  // a reference point or the pupil, outside the outline
};

// As reports and --json name it: "surfaces_cross".
[[nodiscard]] const char* name_of(LensFault fault);

struct LensFinding {
  LensFault fault;
  std::string field;                // of the lens file: "front", "outline", "reference_points_mm.near"
  std::string message;              // what is wrong and what is allowed
  double value = 0.0, limit = 0.0;  // in the unit of the message: mm or D
  std::optional<glm::dvec2> at;     // lens axes, m
};

struct LensCheck {
  double centre_thickness = 0.0;                                 // m
  std::optional<double> thinnest, thinnest_edge, thickest_edge;  // m; none where a surface ends
  std::optional<double> eye_clearance;                           // m; none for contact lenses
  std::optional<double> front_net_error, back_net_error;  // D; none for surfaces that are no height-field splines
  std::vector<LensFinding> findings;                      // empty: the lens is fine
};

[[nodiscard]] LensCheck check_lens(const Lens& lens, Side side, const LensCheckLimits& limits = {});

// How far the curvature of a bicubic height field may be off that of the smooth surface its net stands for, in D of
// surface power, the largest within a radius. A cubic spline over knots h apart misses second derivatives by
// h^2 f''''/12 (de Boor 1978, XII), and h f'''' shows as the jump of the third derivative at a knot.
[[nodiscard]] double net_error(const BsplineHeightField& surface, double index, double radius);

}  // namespace lenses
