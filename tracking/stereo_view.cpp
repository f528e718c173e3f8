#include "tracking/stereo_view.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace tracking {

Pose Pose::inverse() const {
  const glm::dquat back = glm::conjugate(orientation);
  return {back, back * -position};
}

bool Pose::is_finite() const {
  return std::isfinite(position.x) && std::isfinite(position.y) && std::isfinite(position.z) &&
         std::isfinite(orientation.x) && std::isfinite(orientation.y) && std::isfinite(orientation.z) &&
         std::isfinite(orientation.w);
}

Pose operator*(const Pose& parent_from_middle, const Pose& middle_from_child) {
  return {parent_from_middle.orientation * middle_from_child.orientation,
          parent_from_middle.point(middle_from_child.position)};
}

FieldOfView FieldOfView::symmetric(double vertical, double aspect) {
  const double t = std::tan(0.5 * vertical);
  return {t * aspect, t * aspect, t, t};
}

glm::dvec3 direction_from_yaw_pitch(double yaw, double pitch) {
  return {std::sin(yaw) * std::cos(pitch), std::sin(pitch), -std::cos(yaw) * std::cos(pitch)};
}

glm::dquat orientation_from_yaw_pitch(double yaw, double pitch) {
  return glm::angleAxis(-yaw, glm::dvec3(0.0, 1.0, 0.0)) * glm::angleAxis(pitch, glm::dvec3(1.0, 0.0, 0.0));
}

glm::dmat3 listing_rotation(const glm::dvec3& gaze) {
  const glm::dvec3 g = glm::normalize(gaze);
  // Rodrigues with axis (-z) x g = (g.y, -g.x, 0) and cosine -g.z; k = (1 - cos)/sin^2 = 1/(1 + cos), from the sine
  // where 1 - g.z would cancel. Straight back it is the half turn about y.
  const double s2 = g.x * g.x + g.y * g.y;
  if (g.z > 0.0 && !(s2 > 0.0)) {
    return glm::dmat3({-1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, -1.0});
  }
  const double k = g.z <= 0.0 ? 1.0 / (1.0 - g.z) : (1.0 + g.z) / s2;
  const glm::dvec3 x(1.0 - k * g.x * g.x, -k * g.x * g.y, g.x);
  const glm::dvec3 y(-k * g.x * g.y, 1.0 - k * g.y * g.y, g.y);
  return glm::dmat3(x, y, -g);
}

}  // namespace tracking
