// What one traced ray gives: the wavefront that reaches the pupil and what the eye makes of it. Positions and
// directions are in primary-gaze eye axes, matrices in the turned eye's basis, angles counter-clockwise as the wearer
// sees them.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

namespace lenses {

enum class RayStatus { ok, miss_back, miss_front, tir_front, inverted, singular };

[[nodiscard]] constexpr const char* name(RayStatus status) {
  switch (status) {
    case RayStatus::ok:
      return "ok";
    case RayStatus::miss_back:
      return "miss_back";
    case RayStatus::miss_front:
      return "miss_front";
    case RayStatus::tir_front:
      return "tir_front";
    case RayStatus::inverted:
      return "inverted";
    case RayStatus::singular:
      return "singular";
  }
  return "singular";
}

// Only status (and has_lens) means anything unless status is ok.
struct TraceResult {
  RayStatus status = RayStatus::ok;
  bool has_lens = true;                         // false: bare eye, no hits to report
  glm::dvec3 vergence{0.0};                     // hh, hv, vv, D, converging positive
  double power = 0.0, astigmatism = 0.0;        // D
  std::optional<double> axis_deg;               // meridian of the larger curvature; none without astigmatism
  glm::dvec3 back_hit{0.0}, front_hit{0.0};     // m
  glm::dvec3 object_direction{0.0, 0.0, -1.0};  // unit, of the refracted ray, toward the scene
  double deviation = 0.0;                       // between the ray's direction and object_direction, radians
  double accommodation = 0.0;                   // D
  glm::dvec3 residual{0.0};                     // hh, hv, vv, D
  glm::dvec2 blur{0.0};                         // major, minor angular semi-axes, radians
  std::optional<double> blur_axis_deg;          // meridian of the major axis; none for a round blur
};

}  // namespace lenses
