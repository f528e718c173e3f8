// Embree's packets see what its single rays see, whatever the number of rays and threads; and a view's rays on the CPU
// are those of its pixels.
#include "render/scene/packet_tracer.hpp"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "render/chief_rays.hpp"
#include "render/scene/ray_query.hpp"

namespace {

render::Scene two_triangles() {
  render::Scene scene;
  for (const glm::vec3 p : {glm::vec3(-1, -1, -2), glm::vec3(1, -1, -2), glm::vec3(0, 1, -2), glm::vec3(-1, -1, 3),
                            glm::vec3(1, -1, 3), glm::vec3(0, 1, 3)}) {
    scene.vertices.push_back({p, {0, 0, 1}, {}});
  }
  scene.triangles = {{0, 1, 2}, {3, 4, 5}};
  scene.triangle_material = {0, 0};
  scene.materials.emplace_back();
  return scene;
}

TEST(PacketTracer, HitsWhatSingleRaysHit) {
  const render::Scene scene = two_triangles();
  const render::RayQuery single(scene);
  const render::PacketTracer packets(scene);
  std::vector<render::SceneRay> rays;
  std::size_t expected = 0;
  constexpr int kSide = 97;  // no multiple of 16
  for (int i = 0; i < kSide * kSide; ++i) {
    const glm::vec3 d(static_cast<float>(i % kSide) / 48.0F - 1.003F, static_cast<float>(i / kSide) / 48.0F - 1.007F,
                      -1.0F);
    rays.push_back({glm::vec3(0.0F), glm::normalize(i % 3 == 0 ? -d : d)});
    expected += single.closest(glm::dvec3(0.0), glm::dvec3(rays.back().direction)) ? 1 : 0;
  }
  ASSERT_GT(expected, rays.size() / 20);
  EXPECT_EQ(packets.trace(rays, 1).hits, expected);
  EXPECT_EQ(packets.trace(rays, 3).hits, expected);
  EXPECT_EQ(packets.trace({}, 2).hits, 0U);
}

TEST(ChiefRays, BareEyeLooksThroughEachPixelOnce) {
  lenses::LensModel lenses;
  render::ViewSetup view;
  view.lens = lenses::append_lens(lenses, nullptr, lenses::Side::right, 0.00305);
  view.eye = lenses::make_eye_data(lenses::Eye{}, 0.0, 0.0035);
  view.view.fov = tracking::FieldOfView::symmetric(1.0, 1.0);
  view.viewing = render::Viewing::fixed;
  constexpr int kWidth = 10, kHeight = 6;  // no multiples of a tile
  const auto rays = render::chief_rays(view, lenses, kWidth, kHeight);
  ASSERT_EQ(rays.size(), static_cast<std::size_t>(kWidth * kHeight));
  const auto extent = static_cast<float>(view.view.fov.tan_right);
  int corners = 0;
  for (const render::SceneRay& ray : rays) {
    EXPECT_NEAR(glm::length(ray.direction), 1.0F, 1e-6F);
    const float x = ray.direction.x / -ray.direction.z, y = ray.direction.y / -ray.direction.z;
    // Pixel centres: (i + 0.5) / n of the field.
    const float column = (x / extent + 1.0F) * 0.5F * kWidth - 0.5F, row = (1.0F - y / extent) * 0.5F * kHeight - 0.5F;
    EXPECT_NEAR(column, std::round(column), 1e-3F);
    EXPECT_NEAR(row, std::round(row), 1e-3F);
    corners += std::abs(column) < 0.1F && std::abs(row) < 0.1F ? 1 : 0;
  }
  EXPECT_EQ(corners, 1);
}

}  // namespace
