// Surfaces as a lens laboratory thinks of them: base curves, toric surfaces, tilted and decentred ones, bifocal
// segments.
#pragma once

#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>

#include "lenses/design/lens_request.hpp"
#include "lenses/lens.hpp"

namespace lenses::design {

// Vogel's rule for the front surface, by the mean power M: M + 6 for plus lenses, M / 2 + 6 but at least 0.5 for minus.
[[nodiscard]] double vogel_base_curve(double mean_power);

// The surface whose curvatures at its vertex are this matrix. Round to within rounding, it becomes a sphere or a plane
// if `simplest` asks for it.
[[nodiscard]] Surface toric_surface(const glm::dmat2& curvature, ToricForm form, bool simplest);

// Puts a surface so that at the origin it has height 0 and this gradient. A sphere is truly turned (it is moved along
// itself) unless it is so flat that its centre would leave the room a placement has; any other surface is sheared.
[[nodiscard]] Placement tilted(const Surface& surface, const glm::dvec2& gradient);

// Moves the surface's axis to `centre`; height 0 at the origin.
[[nodiscard]] Placement decentred(const Surface& surface, const glm::dvec2& centre);

// The widest lens the rule allows with this surface: 1.8 times the smallest radius, less what a decentration takes.
[[nodiscard]] double widest_diameter(const Surface& surface, const Placement& placement);

// A bifocal's front: a base sphere about `centre` and a segment of curvature `segment_curvature`. The two surfaces have
// one tangent at the segment's own optical centre, so that there the segment adds no prism; and they meet along the
// segment's circle, so that only a straight top is a ledge. The executive's line passes through that centre: no image
// jump in the middle of the line.
[[nodiscard]] SegmentedSurface bifocal_front(const LensRequest& request, double base_curvature,
                                             double segment_curvature, const glm::dvec2& centre);

// Of the three types; lens axes, m. The jump of the image at the segment's top is the addition times the distance from
// there to the optical centre: 5 mm for the flat-top, 12 mm for the round segment, none for the executive.
struct SegmentLayout {
  glm::dvec2 optical_centre{0.0};
  double radius = 0.0;  // of its circle; 0: a straight line over the whole width
  double top = 0.0;     // y
  glm::dvec2 near_point{0.0};
};
[[nodiscard]] SegmentLayout segment_layout(const LensRequest& request);

}  // namespace lenses::design
