// The traversal by VK_KHR_ray_query, on Mesa 25's lavapipe whatever the system's own driver. That it hits what Embree
// hits is traversal_test, which runs there too.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "render/vk/acceleration.hpp"
#include "render/vk/device.hpp"
#include "tests/support/cluttered_room.hpp"
#include "tests/support/device_hits.hpp"
#include "tests/support/lit_scene.hpp"
#include "tests/support/run_program.hpp"

namespace {

using render::Material;
using render::Scene;
using render::SceneRay;
using render::Traversal;

render::vk::Device& device() {
  static render::vk::Device the_device;
  return the_device;
}

std::vector<std::uint32_t> hits_of(const Scene& scene, const std::vector<SceneRay>& rays, Traversal traversal) {
  const render::SceneBuffers buffers(device(), scene);
  return support::device_hits(device(), buffers, rays, static_cast<int>(rays.size()), 1, traversal).triangle;
}

TEST(RayQueries, AreOfferedByTheDriverUnderTest) {
  EXPECT_TRUE(device().limits().has_ray_query) << device().name();
}

// Many leaves half cut away one behind the other, with balls between that show their fronts alone.
Scene leaves_and_balls() {
  Scene scene = support::dark_scene();
  scene.environment.ambient = glm::vec3(0.3F);
  support::add_wall(scene, support::add_material(scene, support::matte(glm::vec3(0.5F))), 0, 0, 9, 8);
  Material leaf = support::matte({0, 1, 0});
  leaf.alpha = Material::Alpha::mask;
  leaf.base_colour_texture.index = support::add_texture(
      scene, 8, 8, [](auto x, auto y) { return glm::uvec4(255, 255, 255, (x / 2 + y / 2) % 2 == 0 ? 0 : 255); });
  Material one_sided_leaf = leaf;
  one_sided_leaf.double_sided = false;
  Material ball = support::matte({1, 0.2F, 0});
  ball.double_sided = false;
  const std::uint32_t leaves[] = {support::add_material(scene, leaf), support::add_material(scene, one_sided_leaf)};
  const std::uint32_t balls = support::add_material(scene, ball);
  for (int i = 0; i < 24; ++i) {
    const float x = 0.31F * static_cast<float>(i % 5) - 0.7F, y = 0.37F * static_cast<float>(i % 4) - 0.5F;
    support::add_wall(scene, leaves[i % 2], x, y, 2.0F + 0.21F * static_cast<float>(i), 0.5F);
    support::add_ball(scene, balls, {-x, y, -3.0F - 0.2F * static_cast<float>(i)}, 0.15F, 8);
  }
  // Around the eye: seen from within, it is not there.
  support::add_ball(scene, balls, {0, 0, 0}, 0.5F, 16);
  return scene;
}

// Every triangle is named as by the traversal that tests one ray after the other.
TEST(RayQueries, LookThroughHolesAndBacks) {
  const Scene scene = leaves_and_balls();
  std::vector<SceneRay> rays;
  for (int y = 0; y < 160; ++y) {
    for (int x = 0; x < 200; ++x) {
      // Off the squares' diagonals, where either of two triangles is right.
      const glm::vec2 at(static_cast<float>(x) + 0.137F, static_cast<float>(y) + 0.411F);
      rays.push_back({glm::vec3(0.0F), glm::normalize(glm::vec3(at.x / 200 - 0.5F, at.y / 200 - 0.4F, -1.0F))});
    }
  }
  const auto expected = hits_of(scene, rays, Traversal::per_ray), hits = hits_of(scene, rays, Traversal::ray_query);
  std::size_t differ = 0;
  std::map<std::uint32_t, std::size_t> seen;  // by material
  for (std::size_t i = 0; i < rays.size(); ++i) {
    differ += hits[i] == expected[i] ? 0 : 1;
    ++seen[hits[i] == ~0U ? ~0U : scene.triangle_material.at(hits[i])];
  }
  // Rays through an edge: either side is right.
  EXPECT_LE(differ, rays.size() / 10000);
  for (std::uint32_t material = 0; material < 4; ++material) EXPECT_GT(seen[material], 100U) << material;
}

// A ray that starts on a triangle does not see it, and one that has none behind it sees nothing.
TEST(RayQueries, StartBeyondWhatTheyStartOn) {
  Scene scene = support::dark_scene();
  const std::uint32_t wall = support::add_material(scene, support::matte(glm::vec3(1.0F)));
  support::add_wall(scene, wall, 0, 0, 1, 1);
  support::add_wall(scene, wall, 0, 0, 2, 1);
  const glm::vec3 ahead(0.0F, 0.0F, -1.0F);
  const std::vector<SceneRay> rays{{{0.3F, 0.2F, 0.0F}, ahead},
                                   {{0.3F, 0.2F, -1.0F}, ahead},
                                   {{0.3F, 0.2F, -2.0F}, ahead},
                                   {{0.3F, 0.2F, -1.5F}, -ahead},
                                   {{0.3F, 0.2F, 0.0F}, glm::vec3(0.0F)}};
  const auto hits = hits_of(scene, rays, Traversal::ray_query);
  EXPECT_EQ(hits, hits_of(scene, rays, Traversal::per_ray));
  EXPECT_LT(hits[0], 2U);
  EXPECT_TRUE(hits[1] == 2U || hits[1] == 3U) << hits[1];
  EXPECT_EQ(hits[2], ~0U);
  EXPECT_LT(hits[3], 2U);
}

TEST(RayQueries, StateTheMemoryOfTheirStructure) {
  const Scene scene = support::cluttered_room(5, 20000);
  const render::SceneBuffers buffers(device(), scene);
  const std::size_t bytes = buffers.acceleration(device()).bytes;
  std::cout << bytes / scene.triangles.size() << " bytes a triangle\n";
  EXPECT_GT(bytes, 36 * scene.triangles.size()) << "less than the corners";
  EXPECT_EQ(&buffers.acceleration(device()), &buffers.acceleration(device())) << "built twice";
}

TEST(RayQueries, RefuseABufferWithoutAStructure) {
  render::KernelSet kernels(device());
  const render::vk::Kernel& kernel = kernels.get(render::Stage::ray_query);
  const render::vk::Buffer plain(device(), 1024, render::vk::Memory::device);
  const std::vector<const render::vk::Buffer*> buffers(16, &plain);
  render::vk::Commands commands(device());
  EXPECT_THROW(commands.dispatch(kernel, buffers, render::vk::bytes_of(render::gpu::FrameData{}), 1),
               std::invalid_argument);
}

TEST(RayQueries, AreSilentlyValid) {
  render::vk::Device validated({.validation = true});
  ASSERT_TRUE(validated.limits().has_ray_query);
  {
    const auto spectacles = lenses::read_spectacles(VERGENCE_ASSETS "/spectacles/presbyopia_bspline_torus.json");
    const auto pair = support::wear(lenses::Wearer{}, &spectacles, tracking::Pose{});
    const auto fov = tracking::FieldOfView::symmetric(50.0 * support::kDegree, 1.0);
    const std::vector<render::ViewSetup> views{
        support::view_along(pair, 0, render::Viewing::gaze, {0.0, 0.0, -1.0}, fov),
        support::view_along(pair, 1, render::Viewing::gaze, {0.0, 0.0, -1.0}, fov)};
    for (const Scene& scene : {leaves_and_balls(), support::cluttered_room(5, 3000)}) {
      render::Renderer renderer(validated, scene, {.traversal = Traversal::ray_query});
      for (const int size : {24, 33}) {  // the buffers change size in between
        render::FrameConfig config;
        config.width = size;
        config.height = 20;
        const auto frame = renderer.render(pair.model, views, config);
        EXPECT_NE(std::ranges::find(frame.stages, "ray_query", &render::vk::StageTime::name), frame.stages.end());
      }
    }
  }
  for (const std::string& message : validated.validation_messages()) ADD_FAILURE() << message;
}

TEST(RayQueries, ServeTheBench) {
  const auto result =
      support::run_program({.arguments = {"bench", "--scene", std::string(VERGENCE_BUILT_ASSETS) + "/reading_room.glb",
                                          "--size", "16", "--rounds", "1", "--lens", "none", "--mode", "pin",
                                          "--shading", "bare", "--traversal", "ray_query", "--json"},
                            .time_limit = std::chrono::seconds(300)});
  ASSERT_EQ(result.exit_status, 0) << result.err;
  EXPECT_TRUE(nlohmann::json::parse(result.out).at(0)["stages_ms"].contains("ray_query")) << result.out;
}

}  // namespace
