#include "render/view_setup.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <stdexcept>

namespace render {

gpu::ViewData make_view_data(const ViewSetup& setup, const lenses::LensModel& lenses) {
  const double gaze_length = glm::length(setup.view.gaze);
  if (!setup.world_from_eye.is_finite() || !setup.view.head_from_view.is_finite() || !std::isfinite(gaze_length) ||
      !(gaze_length > 0.0)) {
    throw std::invalid_argument("a view's pose or gaze is not finite");
  }
  gpu::ViewData data{};
  data.lens = lenses::to_float(lenses.lens[setup.lens]);
  data.eye = lenses::to_float(setup.eye);
  data.eye.pupil.z = static_cast<float>(setup.accommodation.value_or(-1.0));
  const glm::dmat3 picture = glm::mat3_cast(glm::normalize(setup.view.head_from_view.orientation));
  data.picture_x = glm::vec4(glm::vec3(picture[0]), 0.0F);
  data.picture_y = glm::vec4(glm::vec3(picture[1]), 0.0F);
  data.picture_z = glm::vec4(glm::vec3(picture[2]), 0.0F);
  const tracking::FieldOfView& fov = setup.view.fov;
  data.tangents = glm::vec4(fov.tan_left, fov.tan_right, fov.tan_down, fov.tan_up);
  data.gaze = glm::vec4(glm::vec3(glm::normalize(setup.view.gaze)), static_cast<float>(setup.viewing));
  const glm::dmat3 world = glm::mat3_cast(glm::normalize(setup.world_from_eye.orientation));
  const glm::dvec3 position = setup.world_from_eye.position;
  data.world_x = glm::vec4(glm::vec3(world[0]), static_cast<float>(position.x));
  data.world_y = glm::vec4(glm::vec3(world[1]), static_cast<float>(position.y));
  data.world_z = glm::vec4(glm::vec3(world[2]), static_cast<float>(position.z));
  data.tint = glm::vec4(glm::vec3(setup.tint), 0.0F);
  if (setup.virtual_image) {
    data.virtual_image = glm::vec4(setup.virtual_image->distance, setup.virtual_image->origin_behind_pupil, 0.0, 0.0);
  }
  return data;
}

std::uint32_t view_traits(const std::vector<ViewSetup>& views, const lenses::LensModel& lenses) {
  std::uint32_t traits = 0;
  for (const ViewSetup& view : views) {
    traits |= 1U << static_cast<unsigned>(view.viewing);
    traits |= lenses.lens[view.lens].mount.x == 1 ? 8U : 0U;
    traits |= view.virtual_image ? 16U : 0U;
  }
  return traits;
}

}  // namespace render
