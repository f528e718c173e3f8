// The vocabulary between whoever knows where head and eyes are (OpenXR, a trace, a command line) and whoever renders:
// poses, fields of view, gaze. Metres, radians, axes as in OpenXR (x right, y up, -z forward). No other folder is
// included here.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tracking {

enum class Side { right, left };

// fixed: all rays start at the primary-gaze pupil; scanning: the eye turns to each direction; gaze: one pupil, turned
// to the gaze.
enum class Viewing { fixed, scanning, gaze };

// A rigid pose: x_parent = orientation * x_child + position.
struct Pose {
  glm::dquat orientation{1.0, 0.0, 0.0, 0.0};
  glm::dvec3 position{0.0};

  [[nodiscard]] glm::dvec3 point(const glm::dvec3& p) const { return orientation * p + position; }
  [[nodiscard]] glm::dvec3 direction(const glm::dvec3& d) const { return orientation * d; }
  [[nodiscard]] Pose inverse() const;
  [[nodiscard]] bool is_finite() const;
};

[[nodiscard]] Pose operator*(const Pose& parent_from_middle, const Pose& middle_from_child);

// Tangents of the half angles, measured from the view's own axis; all four are positive in a symmetric view.
// (OpenXR's signed angles: left = tan(-angleLeft), down = tan(-angleDown).)
struct FieldOfView {
  double tan_left = 0.0, tan_right = 0.0, tan_down = 0.0, tan_up = 0.0;

  // vertical: full vertical angle in radians; aspect: width / height.
  [[nodiscard]] static FieldOfView symmetric(double vertical, double aspect);
};

// Yaw to the right and pitch up (radians) to a unit direction: yaw first about y, then pitch; (0, 0) is -z.
[[nodiscard]] glm::dvec3 direction_from_yaw_pitch(double yaw, double pitch);
// The orientation that turns -z to yaw (to the right) and pitch (up), the horizon kept level.
[[nodiscard]] glm::dquat orientation_from_yaw_pitch(double yaw, double pitch);

// Listing's law: the smallest rotation from -z to a gaze direction (any length, in head axes).
[[nodiscard]] glm::dmat3 listing_rotation(const glm::dvec3& gaze);

// One eye's view as the renderer needs it.
struct EyeView {
  Pose head_from_view;  // the picture's own frame: its -z is the picture's axis, its origin is unused by rays that
                        // start at the pupil
  FieldOfView fov;
  glm::dvec3 gaze{0.0, 0.0, -1.0};  // line of sight before the lens, head axes
};

}  // namespace tracking
