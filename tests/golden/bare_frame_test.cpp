// A bare frame is drawn as the benchmark says: base colours, the first light alone, no shadow, one ray a pixel; and
// apart from that it is the same picture.
#include <gtest/gtest.h>

#include <algorithm>

#include "render/image/image.hpp"
#include "render/renderer.hpp"
#include "render/vk/device.hpp"
#include "tests/support/worn_views.hpp"

namespace {

void add_quad(render::Scene& scene, const glm::vec3& corner, const glm::vec3& side, const glm::vec3& up) {
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  const glm::vec3 normal = glm::normalize(glm::cross(side, up));
  for (const glm::vec3& p : {corner, corner + side, corner + side + up, corner + up}) {
    scene.vertices.push_back({p, normal, {}});
  }
  scene.triangles.insert(scene.triangles.end(), {{first, first + 1, first + 2}, {first, first + 2, first + 3}});
  scene.triangle_material.insert(scene.triangle_material.end(), 2, 0);
}

// A white wall that fills the view, lit from above; on demand a shelf out of view keeps the first light off it, and a
// second light shines from below.
render::Scene wall_scene(bool shelf, bool second_light) {
  render::Scene scene;
  scene.materials.emplace_back();
  scene.materials[0].double_sided = true;
  scene.materials[0].metallic = 0.0F;  // matte: a bare frame knows no other material
  scene.materials[0].roughness = 1.0F;
  add_quad(scene, {-3, -3, -2}, {6, 0, 0}, {0, 6, 0});
  if (shelf) {
    add_quad(scene, {-3, 1.2F, -1.99F}, {6, 0, 0}, {0, 0, 0.9F});
  }
  render::Light light;
  light.position = {0, 3, -1};
  light.colour = glm::vec3(6.0F);
  scene.lights.push_back(light);
  if (second_light) {
    light.position = {0, -3, -1};
    light.colour = glm::vec3(1.0F);
    scene.lights.push_back(light);
  }
  return scene;
}

render::RenderedFrame draw(const render::Scene& scene, bool bare) {
  render::vk::Device device({.validation = true});
  const support::WornPair pair = support::wear(lenses::Wearer{}, nullptr, {});
  render::FrameConfig config;
  config.width = config.height = 48;
  config.mode = render::Mode::pinhole;
  config.bare = bare;
  const auto fov = tracking::FieldOfView::symmetric(40.0 * support::kDegree, 1.0);
  auto frame =
      render::Renderer(device, scene)
          .render(pair.model, {support::view_along(pair, 0, support::Viewing::fixed, {0, 0, -1}, fov)}, config);
  for (const std::string& message : device.validation_messages()) {
    ADD_FAILURE() << message;
  }
  return frame;
}

bool has_stage(const render::RenderedFrame& frame, const std::string& name) {
  return std::ranges::find(frame.stages, name, &render::vk::StageTime::name) != frame.stages.end();
}

// One step of 8 bits: the wall's triangles may be met in another order.
constexpr double kSame = 1.01 / 255.0;

TEST(BareFrame, HasOneLightAndNoShadow) {
  const auto wanted = draw(wall_scene(false, false), true);
  const auto bare = draw(wall_scene(true, true), true);
  EXPECT_LE(render::compare(bare.views[0].display, wanted.views[0].display).max_abs, kSame);
  const auto full = draw(wall_scene(true, true), false);
  EXPECT_GT(render::compare(full.views[0].display, wanted.views[0].display).max_abs, 0.1) << "shadow and second light";
}

TEST(BareFrame, IsTheFullOneWhereNothingIsLeftOut) {
  const render::Scene scene = wall_scene(false, false);
  const auto bare = draw(scene, true), full = draw(scene, false);
  EXPECT_LE(render::compare(bare.views[0].display, full.views[0].display).max_abs, kSame);
  EXPECT_TRUE(has_stage(full, "edges"));
  EXPECT_FALSE(has_stage(bare, "edges"));
}

}  // namespace
