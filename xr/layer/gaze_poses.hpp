// From gaze directions to the poses that OpenXR speaks of: pure, nothing of a runtime in it.
#pragma once

#include "xr/openxr_compat.hpp"

#include <array>
#include <glm/vec3.hpp>

#include "tracking/stereo_view.hpp"

namespace xr::layer {

// Half the distance between the pupils that the layer gives its eyes, m: a trace has directions only.
inline constexpr double kHalfPupillaryDistance = 0.0315;

// The direction from the point midway between the eyes to the point that both look at. Seen on a plane across the line
// of sight the middle eye's point is midway between the two eyes' points, whatever the distance.
[[nodiscard]] glm::dvec3 combined_direction(const std::array<glm::dvec3, 2>& direction);

// -z along the direction, turned as Listing's law turns an eye.
[[nodiscard]] tracking::Pose gaze_pose(const glm::dvec3& direction, const glm::dvec3& origin);
[[nodiscard]] tracking::Pose eye_pose(tracking::Side side, const std::array<glm::dvec3, 2>& direction);

// What may be said of a gaze pose that hangs on a head so located: both TRACKED bits or none, as the extension asks.
[[nodiscard]] XrSpaceLocationFlags gaze_flags(XrSpaceLocationFlags head);

}  // namespace xr::layer
