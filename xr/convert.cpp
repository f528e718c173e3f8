#include "xr/convert.hpp"

#include <cmath>

namespace xr {

tracking::Pose pose_of(const XrPosef& pose) {
  const glm::dquat orientation(pose.orientation.w, pose.orientation.x, pose.orientation.y, pose.orientation.z);
  return {glm::normalize(orientation), {pose.position.x, pose.position.y, pose.position.z}};
}

XrPosef to_xr(const tracking::Pose& pose) {
  const auto f = [](double v) { return static_cast<float>(v); };
  return {{f(pose.orientation.x), f(pose.orientation.y), f(pose.orientation.z), f(pose.orientation.w)},
          {f(pose.position.x), f(pose.position.y), f(pose.position.z)}};
}

tracking::FieldOfView fov_of(const XrFovf& fov) {
  const auto tangent = [](float angle) { return std::tan(static_cast<double>(angle)); };
  return {-tangent(fov.angleLeft), tangent(fov.angleRight), -tangent(fov.angleDown), tangent(fov.angleUp)};
}

}  // namespace xr
