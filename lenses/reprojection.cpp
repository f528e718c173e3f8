#include "lenses/reprojection.hpp"

#include <glm/geometric.hpp>

namespace lenses {
namespace {

// The basis beyond a surface as the ray transfer carries it on.
glm::dvec3 carried_on(const glm::dvec3& e, const glm::dvec3& direction) {
  return glm::normalize(e - glm::dot(e, direction) * direction);
}

}  // namespace

double thin_lens_reprojection_error(double power, double pupil_distance, double turn) {
  const double slopes = 1.0 - power * pupil_distance;  // beyond the lens to before it
  return turn * (1.0 - slopes) / slopes;
}

glm::dvec2 reprojection_error(const f64::LensData& lens, const f64::SightLine& line, const glm::dvec3& turn) {
  if (lens.glass.w == 0.0 || lens.mount.x == 1 || line.status != f64::kStatusOk) {
    return glm::dvec2(0.0);
  }
  const glm::dvec3 in_glass = f64::from_lens_direction(lens, line.path.direction_glass);
  const glm::dvec3 beyond_h = carried_on(carried_on(line.e_h, in_glass), line.direction_object);
  const glm::dvec3 beyond_v = glm::cross(beyond_h, line.direction_object);
  const glm::dvec3 leans = glm::cross(turn, line.direction);           // the pixel that was drawn for this direction
  const glm::dvec3 belongs = glm::cross(turn, line.direction_object);  // what belongs there now
  const glm::dmat2 slopes = f64::sight_line_transfer(lens, line).d;
  const glm::dvec2 shown = slopes * glm::dvec2(glm::dot(leans, line.e_h), glm::dot(leans, line.e_v));
  const glm::dvec2 wanted(glm::dot(belongs, beyond_h), glm::dot(belongs, beyond_v));
  return glm::inverse(slopes) * (shown - wanted);
}

}  // namespace lenses
