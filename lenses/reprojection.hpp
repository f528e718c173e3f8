// What a compositor's reprojection does to a picture through a lens. It turns the finished picture by how far the head
// has turned since, as if all that is seen stood in the world; but the lens turns with the head.
//
// Towards a head direction h the lens shows the world's direction h + d(h), d its deviation. After a turn by the small
// vector w (as t -> t + w x t of every direction) the pixel h holds what belongs to h + w x h. The picture is off by
// what the two differ by: the deviation's change over the turn, less the turn of the deviation itself.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "lenses/engine.hpp"

namespace lenses {

// In the picture, rad, over e_h and e_v of the sight line at that direction: where what is shown in that direction
// belongs, less that direction, of first order in the turn. `turn`: rad, a rotation vector in head axes (angular
// velocity times the time between the pose that was drawn for and the one that is shown). 0 for a bare eye, and for a
// contact lens, which stays with an eye that counters the head's turn.
[[nodiscard]] glm::dvec2 reprojection_error(const f64::LensData& lens, const f64::SightLine& line,
                                            const glm::dvec3& turn);

// The same in thin-lens terms, for a turn across a line of sight through the optical centre: P L / (1 - P L) times the
// turn, against it where positive; P the lens's power (D), L its distance from the pupil (m).
[[nodiscard]] double thin_lens_reprojection_error(double power, double pupil_distance, double turn);

}  // namespace lenses
