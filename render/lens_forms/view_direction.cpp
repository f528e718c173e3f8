#include "render/lens_forms/view_direction.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace render {

namespace f64 = lenses::f64;

glm::dvec3 view_direction(const ViewSetup& view, const glm::dvec2& at) {
  const tracking::FieldOfView& fov = view.view.fov;
  const glm::dvec3 in_picture(glm::mix(-fov.tan_left, fov.tan_right, at.x), glm::mix(fov.tan_up, -fov.tan_down, at.y),
                              -1.0);
  const glm::dvec3 direction = glm::normalize(glm::normalize(view.view.head_from_view.orientation) * in_picture);
  if (!view.virtual_image) {
    return direction;
  }
  // A headset's pixel is a point of its virtual image, seen from where the pupil really is.
  const glm::dvec3 point =
      glm::dvec3(0.0, 0.0, view.virtual_image->origin_behind_pupil) + view.virtual_image->distance * direction;
  const glm::dmat3 turn = f64::eye_turn(static_cast<int>(view.viewing), glm::normalize(view.view.gaze), direction);
  return glm::normalize(point - f64::turned_pupil(turn, view.eye.pupil.y));
}

}  // namespace render
