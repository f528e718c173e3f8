#include "render/chief_rays.hpp"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <optional>

#include "lenses/engine.hpp"

namespace render {
namespace {

namespace f32 = lenses::f32;

std::optional<SceneRay> chief_ray(const gpu::ViewData& view, const f32::Table& table, const glm::vec2& at) {
  const glm::mat3 picture(glm::vec3(view.picture_x), glm::vec3(view.picture_y), glm::vec3(view.picture_z));
  const glm::vec2 tangents(glm::mix(-view.tangents.x, view.tangents.y, at.x),
                           glm::mix(view.tangents.w, -view.tangents.z, at.y));
  const glm::vec3 direction = glm::normalize(picture * glm::vec3(tangents, -1.0F));
  const glm::mat3 turn = f32::eye_turn(static_cast<int>(view.gaze.w), glm::vec3(view.gaze), direction);
  const f32::SightLine line =
      f32::trace_sight_line(table, view.lens, view.eye, turn, direction, glm::vec2(0.0F), glm::vec2(0.0F));
  if (line.status != f32::kStatusOk && line.status != f32::kStatusMissBack) return std::nullopt;
  const glm::mat3 world(glm::vec3(view.world_x), glm::vec3(view.world_y), glm::vec3(view.world_z));
  const glm::vec3 eye(view.world_x.w, view.world_y.w, view.world_z.w);
  return SceneRay{world * line.start + eye, glm::normalize(world * line.direction_object)};
}

}  // namespace

std::vector<SceneRay> chief_rays(const ViewSetup& view, const lenses::LensModel& lenses, int width, int height) {
  constexpr int kTile = 4;
  const gpu::ViewData data = make_view_data(view, lenses);
  const std::vector<glm::vec4> entries = lenses::to_float(lenses.table);
  const f32::Table table{entries};
  std::vector<SceneRay> rays;
  rays.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int top = 0; top < height; top += kTile) {
    for (int left = 0; left < width; left += kTile) {
      for (int y = top; y < std::min(top + kTile, height); ++y) {
        for (int x = left; x < std::min(left + kTile, width); ++x) {
          const glm::vec2 at((static_cast<float>(x) + 0.5F) / static_cast<float>(width),
                             (static_cast<float>(y) + 0.5F) / static_cast<float>(height));
          if (const auto ray = chief_ray(data, table, at)) rays.push_back(*ray);
        }
      }
    }
  }
  return rays;
}

}  // namespace render
