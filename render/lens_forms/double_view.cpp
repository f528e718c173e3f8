#include "render/lens_forms/double_view.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <span>

namespace render {
namespace gpu {
#include "render/shaders/double_view.h"
}  // namespace gpu

namespace {

using Part = std::span<glm::dvec4>;

void lay_axes(Part at, const glm::dquat& orientation, const glm::dvec3& position = glm::dvec3(0.0)) {
  const glm::dmat3 axes = glm::mat3_cast(glm::normalize(orientation));
  for (glm::length_t i = 0; i < 3; ++i) {
    at[static_cast<std::size_t>(i)] = glm::dvec4(axes[i], position[i]);
  }
}

void lay_surface(Part at, const lenses::f64::SurfaceData& s) {
  std::ranges::copy(std::initializer_list<glm::dvec4>{s.shape, s.frame, s.domain, glm::dvec4(s.kind),
                                                      glm::dvec4(s.offset), s.shift, s.slope, glm::dvec4(s.parts)},
                    at.begin());
}

void lay_view(Part at, const ViewSetup& setup, const lenses::f64::LensData& lens) {
  lay_axes(at.subspan(gpu::kDoublePictureAt), setup.view.head_from_view.orientation);
  const tracking::FieldOfView& fov = setup.view.fov;
  at[gpu::kDoubleTangentsAt] = {fov.tan_left, fov.tan_right, fov.tan_down, fov.tan_up};
  at[gpu::kDoubleGazeAt] = glm::dvec4(glm::normalize(setup.view.gaze), static_cast<double>(setup.viewing));
  lay_axes(at.subspan(gpu::kDoubleWorldAt), setup.world_from_eye.orientation, setup.world_from_eye.position);
  if (setup.virtual_image) {
    at[gpu::kDoubleVirtualImageAt] = {setup.virtual_image->distance, setup.virtual_image->origin_behind_pupil, 0.0,
                                      0.0};
  }
  at[gpu::kDoubleExcessAt] = setup.eye.excess;
  at[gpu::kDoublePupilAt] = setup.eye.pupil;
  at[gpu::kDoublePupilAt].z = setup.accommodation.value_or(-1.0);
  std::ranges::copy(
      std::initializer_list<glm::dvec4>{lens.axis_x, lens.axis_y, lens.axis_z, lens.glass, glm::dvec4(lens.mount)},
      at.begin() + gpu::kDoubleLensAt);
  lay_surface(at.subspan(gpu::kDoubleBackAt), lens.back);
  lay_surface(at.subspan(gpu::kDoubleFrontAt), lens.front);
}

}  // namespace

std::vector<glm::dvec4> double_views(const std::vector<ViewSetup>& views, const lenses::LensModel& lenses) {
  constexpr std::size_t kEach = gpu::kDoubleView;
  std::vector<glm::dvec4> all(kEach * gpu::kMostViews, glm::dvec4(0.0));
  for (std::size_t i = 0; i < views.size(); ++i) {
    lay_view(Part(all).subspan(kEach * i, kEach), views[i], lenses.lens[views[i].lens]);
  }
  return all;
}

}  // namespace render
