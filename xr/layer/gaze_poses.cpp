#include "xr/layer/gaze_poses.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace xr::layer {

using tracking::Pose;
using tracking::Side;

glm::dvec3 combined_direction(const std::array<glm::dvec3, 2>& direction) {
  const glm::dvec3& right = direction[static_cast<int>(Side::right)];
  const glm::dvec3& left = direction[static_cast<int>(Side::left)];
  if (right.z < 0.0 && left.z < 0.0) {
    return glm::normalize(right / -right.z + left / -left.z);
  }
  const glm::dvec3 sum = glm::normalize(right) + glm::normalize(left);
  return glm::length(sum) > 0.0 ? glm::normalize(sum) : glm::normalize(right);
}

Pose gaze_pose(const glm::dvec3& direction, const glm::dvec3& origin) {
  return {glm::normalize(glm::quat_cast(tracking::listing_rotation(direction))), origin};
}

Pose eye_pose(Side side, const std::array<glm::dvec3, 2>& direction) {
  const double x = side == Side::right ? kHalfPupillaryDistance : -kHalfPupillaryDistance;
  return gaze_pose(direction[static_cast<int>(side)], {x, 0.0, 0.0});
}

XrSpaceLocationFlags gaze_flags(XrSpaceLocationFlags head) {
  constexpr XrSpaceLocationFlags kValid =
      XR_SPACE_LOCATION_POSITION_VALID_BIT | XR_SPACE_LOCATION_ORIENTATION_VALID_BIT;
  constexpr XrSpaceLocationFlags kTracked =
      XR_SPACE_LOCATION_POSITION_TRACKED_BIT | XR_SPACE_LOCATION_ORIENTATION_TRACKED_BIT;
  if ((head & kValid) != kValid) {
    return 0;
  }
  return (head & kTracked) == kTracked ? kValid | kTracked : kValid;
}

}  // namespace xr::layer
