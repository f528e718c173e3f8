#include "render/scene/framing.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace render {

tracking::Pose framing_pose(const Scene& scene) {
  constexpr double kSineOfHalfView = 0.5;   // of 60 degrees
  constexpr double kReadingDistance = 0.4;  // m
  glm::vec3 low(std::numeric_limits<float>::max()), high(std::numeric_limits<float>::lowest());
  for (const glm::uvec3& triangle : scene.triangles) {
    for (int corner = 0; corner < 3; ++corner) {
      const glm::vec3& position = scene.vertices[triangle[corner]].position;
      low = glm::min(low, position);
      high = glm::max(high, position);
    }
  }
  // The ball around the box of all corners.
  const glm::dvec3 middle = 0.5 * (glm::dvec3(low) + glm::dvec3(high));
  const double radius = 0.5 * glm::length(glm::dvec3(high) - glm::dvec3(low));
  const double distance = std::max(radius / kSineOfHalfView, radius + kReadingDistance);
  return {glm::dquat(1.0, 0.0, 0.0, 0.0), middle + glm::dvec3(0.0, 0.0, distance)};
}

}  // namespace render
