// Embree's packets see what its single rays look at, whatever the number of rays and threads, and past backs and holes;
// and a view's rays on the CPU are those of its pixels.
#include "render/scene/packet_tracer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "render/chief_rays.hpp"
#include "render/scene/ray_query.hpp"
#include "tests/support/scene_oracle.hpp"

namespace {

using scene_oracle::add_quad;

// From (0, 0, 0), all around ahead and, every third, behind; their number is no multiple of 16.
std::vector<render::SceneRay> fan() {
  std::vector<render::SceneRay> rays;
  constexpr int kSide = 97;
  for (int i = 0; i < kSide * kSide; ++i) {
    const glm::vec3 d(static_cast<float>(i % kSide) / 48.0F - 1.003F, static_cast<float>(i / kSide) / 48.0F - 1.007F,
                      -1.0F);
    rays.push_back({glm::vec3(0.0F), glm::normalize(i % 3 == 0 ? -d : d)});
  }
  return rays;
}

// What the rays hit, and that the timed run counts as many whatever its threads.
std::vector<std::uint32_t> traced(const render::Scene& scene, const std::vector<render::SceneRay>& rays) {
  const render::PacketTracer packets(scene);
  const std::vector<std::uint32_t> found = packets.triangles_hit(rays);
  const auto misses = std::ranges::count(found, render::PacketTracer::kNoTriangle);
  const std::size_t hits = rays.size() - static_cast<std::size_t>(misses);
  EXPECT_EQ(packets.trace(rays, 1).hits, hits);
  EXPECT_EQ(packets.trace(rays, 3).hits, hits);
  EXPECT_EQ(packets.trace({}, 2).hits, 0U);
  return found;
}

TEST(PacketTracer, SeesWhatSingleRaysLookAt) {
  // Two triangles before the eye, the nearer with its back towards it, and one behind the eye.
  render::Scene scene;
  scene_oracle::add_triangle(scene, {-1, -1, -1}, {0, 1, -1}, {1, -1, -1}, 0);
  scene_oracle::add_triangle(scene, {-2, -2, -2}, {2, -2, -2}, {0, 2, -2}, 0);
  scene_oracle::add_triangle(scene, {-1, -1, 3}, {1, -1, 3}, {0, 1, 3}, 1);
  scene.materials[1].double_sided = true;
  const auto rays = fan();
  const auto found = traced(scene, rays);
  const render::RayQuery single(scene);
  std::array<int, 3> seen{};
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const auto hit = single.looked_at(glm::dvec3(0.0), glm::dvec3(rays[i].direction));
    ASSERT_EQ(found[i], hit ? hit->triangle : render::PacketTracer::kNoTriangle) << i;
    if (hit) ++seen.at(hit->triangle);
  }
  EXPECT_EQ(seen[0], 0) << "a back that is not seen";
  EXPECT_GT(seen[1], 100);
  EXPECT_GT(seen[2], 100) << "a back that is seen";
}

TEST(PacketTracer, SeesTheReadingRoomAsSingleRaysDo) {
  const render::Scene room = render::read_gltf(VERGENCE_BUILT_ASSETS "/reading_room.glb");
  std::vector<render::SceneRay> rays = fan();
  const glm::dvec3 eye = room.start_pose().value_or(tracking::Pose{}).position;
  for (render::SceneRay& ray : rays) ray.origin = glm::vec3(eye);
  const auto found = traced(room, rays);
  const render::RayQuery single(room);
  int unlike = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const auto hit = single.looked_at(glm::dvec3(rays[i].origin), glm::dvec3(rays[i].direction));
    unlike += found[i] == (hit ? hit->triangle : render::PacketTracer::kNoTriangle) ? 0 : 1;
  }
  // Coplanar squares (ink on paper) and rays on a shared edge may go either way.
  EXPECT_LT(unlike, static_cast<int>(rays.size()) / 1000);
}

// A single-sided screen with upright stripes of holes at 1 m before a single-sided wall at 2 m; u runs from 0 to 1
// across the screen.
struct Screen {
  render::Scene scene;

  explicit Screen(const render::TextureUse& use) {
    add_quad(scene, {-1, -1, -1}, {2, 0, 0}, {0, 2, 0}, 0);
    add_quad(scene, {-9, -9, -2}, {18, 0, 0}, {0, 18, 0}, 1);
    for (render::Vertex& v : scene.vertices) v.uv = {0.5F + 0.5F * v.position.x, 0.5F - 0.5F * v.position.y};
    scene.materials[0].alpha = render::Material::Alpha::mask;
    scene.materials[0].base_colour_texture = use;
    render::Texture texture;
    texture.width = 4;
    texture.height = 1;
    texture.rgba = {0, 0, 0, 255, 0, 0, 0, 0, 0, 0, 0, 255, 0, 0, 0, 0};  // there, hole, there, hole
    scene.textures.push_back(texture);
  }

  // Rays to where `is_hole(u)` says what is seen, but for those within the last digits of a stripe's edge.
  template <class Hole>
  void expect(Hole&& is_hole) const {
    const auto rays = fan();
    const auto found = traced(scene, rays);
    const render::RayQuery single(scene);
    int holes = 0, there = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const glm::vec3 d = rays[i].direction;
      const glm::vec2 at = glm::vec2(d.x, d.y) / -d.z;
      const float u = 0.5F + 0.5F * at.x, edge = std::abs(4.0F * u - std::round(4.0F * u));
      if (d.z > 0.0F || std::abs(at.x) > 0.999F || std::abs(at.y) > 0.999F || edge < 1e-4F) continue;
      const bool hole = is_hole(u);
      ASSERT_EQ(found[i] >= 2, hole) << at.x << " " << at.y;
      ASSERT_EQ(single.looked_at(glm::dvec3(0.0), glm::dvec3(d)).value().triangle, found[i]);
      ++(hole ? holes : there);
    }
    EXPECT_GT(holes, 1000);
    EXPECT_GT(there, 1000);
  }
};

TEST(PacketTracer, GoesThroughHolesOfCutOuts) {
  const auto odd = [](float x) { return (static_cast<int>(std::floor(x)) & 1) != 0; };
  // Between two texels alpha falls in a straight line through the cutoff of a half, on the texels' common edge.
  Screen({.index = 0}).expect([&](float u) { return odd(4.0F * u); });
  // Twice as fine, and shifted by a texel.
  Screen finer({.index = 0, .linear = glm::mat2(2.0F, 0.0F, 0.0F, 1.0F), .offset = {0.25F, 0.0F}});
  finer.expect([&](float u) { return odd(8.0F * u + 1.0F); });
  // Mirrored outside: 0 1 2 3 3 2 1 0.
  Screen mirrored({.index = 0, .linear = glm::mat2(2.0F, 0.0F, 0.0F, 1.0F)});
  mirrored.scene.textures[0].wrap_u = render::Texture::Wrap::mirror;
  mirrored.expect([&](float u) { return odd(8.0F * u) != (u > 0.5F); });
  // Clamped: the last texel, a hole, goes on.
  Screen clamped({.index = 0, .linear = glm::mat2(2.0F, 0.0F, 0.0F, 1.0F)});
  clamped.scene.textures[0].wrap_u = render::Texture::Wrap::clamp;
  clamped.expect([&](float u) { return odd(8.0F * u) || u > 0.5F; });
}

TEST(PacketTracer, CutOutsHaveBacksAndVertexAlpha) {
  Screen screen(render::TextureUse{});
  screen.scene.colours.assign(screen.scene.vertices.size(), glm::vec4(1.0F));
  for (std::size_t i = 0; i < screen.scene.vertices.size(); ++i) {
    screen.scene.colours[i].a = screen.scene.vertices[i].uv.x;
  }
  // Alpha grows with u, times the material's.
  screen.scene.materials[0].base_colour.a = 0.8F;
  screen.scene.materials[0].alpha_cutoff = 0.6F;
  screen.expect([](float u) { return u < 0.75F; });
  for (glm::uvec3& t : screen.scene.triangles) std::swap(t.y, t.z);
  const auto backs = traced(screen.scene, fan());
  EXPECT_EQ(std::ranges::count(backs, render::PacketTracer::kNoTriangle), std::ssize(backs));
  screen.scene.materials[0].double_sided = screen.scene.materials[1].double_sided = true;
  screen.expect([](float u) { return u < 0.75F; });
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
