// Every traversal hits what Embree hits, and the picture does not depend on which one is at work. Runs with the
// system's driver and with Mesa 25's lavapipe, which has ray queries.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>

#include "render/scene/packet_tracer.hpp"
#include "render/vk/acceleration.hpp"
#include "render/vk/device.hpp"
#include "tests/support/cluttered_room.hpp"
#include "tests/support/device_hits.hpp"
#include "tests/support/worn_views.hpp"

namespace {

using render::Scene;
using render::SceneRay;
using render::Traversal;

constexpr int kWidth = 333, kHeight = 251;  // no multiples of a tile
constexpr std::uint32_t kNone = 0xFFFFFFFFU;

render::vk::Device& device() {
  static render::vk::Device the_device;
  return the_device;
}

struct NamedTraversal {
  Traversal traversal;
  std::string name;
};

// All that this device has; ray_query_test sees to it that one of those tested has ray queries.
std::vector<NamedTraversal> all_traversals() {
  std::vector<NamedTraversal> all{{Traversal::per_ray, "per_ray"}, {Traversal::tile, "tile"}};
  if (device().limits().has_ray_query) all.push_back({Traversal::ray_query, "ray_query"});
  return all;
}

// 12 degrees and more of deviation, its rim well inside the picture.
lenses::Spectacles strong_prism() {
  lenses::Lens lens;
  lens.index = 1.74;
  lens.centre_thickness = 0.008;
  lens.diameter = 0.034;
  lens.front = lenses::Sphere{1.0 / 0.060};
  lens.back = lenses::Sphere{1.0 / 0.050};
  lens.fit.decentration = {0.006, -0.004};
  lens.fit.wrap = 20.0 * support::kDegree;
  lens.fit.pantoscopic_tilt = -15.0 * support::kDegree;
  return {"strong prism", {lens, lens}, glm::dvec3(1.0)};
}

struct Glasses {
  std::string name;
  std::optional<lenses::Spectacles> worn;
};

std::vector<Glasses> all_glasses() {
  return {{"none", std::nullopt},
          {"strong prism", strong_prism()},
          {"myopia", lenses::read_spectacles(VERGENCE_ASSETS "/spectacles/myopia.json")},
          {"progressive", lenses::read_spectacles(VERGENCE_ASSETS "/spectacles/presbyopia_bspline_torus.json")}};
}

struct Place {
  std::string name;
  Scene scene;
  tracking::Pose head;
};

std::vector<Place> places() {
  std::vector<Place> all;
  Scene room = support::reading_room();
  const tracking::Pose in_room = room.start_pose().value();
  all.push_back({"reading room", std::move(room), in_room});
  all.push_back({"cluttered room", support::cluttered_room(7, 60000), tracking::Pose{}});
  tracking::Pose above;
  above.position = {0.3, 2.5, 9.0};
  above.orientation = tracking::orientation_from_yaw_pitch(0.3, -0.35);
  all.push_back({"waves", scene_oracle::waves(120), above});
  return all;
}

// The rays beyond the lens as floats; a rim has none. A wide picture, so that rims and steep rays are in it.
std::vector<SceneRay> rays_of(const support::WornPair& pair, const render::ViewSetup& view) {
  std::vector<SceneRay> rays;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const auto pixel = support::reference_pixel(pair, view, support::pixel_direction(view, x, y, kWidth, kHeight));
      const bool rim = pixel.status != lenses::f64::kStatusOk && pixel.status != lenses::f64::kStatusMissBack;
      rays.push_back({glm::vec3(pixel.start), rim ? glm::vec3(0.0F) : glm::vec3(pixel.direction)});
    }
  }
  return rays;
}

double distance_to(const Scene& scene, std::uint32_t triangle, const SceneRay& ray) {
  const glm::uvec3 index = scene.triangles.at(triangle);
  const glm::dvec3 a(scene.vertices[index.x].position);
  const glm::dvec3 n =
      glm::cross(glm::dvec3(scene.vertices[index.y].position) - a, glm::dvec3(scene.vertices[index.z].position) - a);
  return glm::dot(n, a - glm::dvec3(ray.origin)) / glm::dot(n, glm::dvec3(ray.direction));
}

// Another triangle at the same distance - a shared edge, two faces on each other - is the same hit.
bool same_hit(const Scene& scene, const SceneRay& ray, std::uint32_t a, std::uint32_t b) {
  if (a == b || a == kNone || b == kNone) return a == b;
  const double one = distance_to(scene, a, ray), other = distance_to(scene, b, ray);
  return std::abs(one - other) <= 1e-4 * std::abs(other);
}

TEST(Traversals, HitWhatEmbreeHits) {
  const auto fov = tracking::FieldOfView::symmetric(100.0 * support::kDegree, double{kWidth} / kHeight);
  std::size_t pixels = 0, rims = 0;
  std::map<std::string, std::size_t> wrong, handed_on;
  for (const Place& place : places()) {
    const render::PacketTracer embree(place.scene);
    const render::SceneBuffers buffers(device(), place.scene);
    for (const Glasses& glasses : all_glasses()) {
      const auto pair = support::wear(lenses::Wearer{}, glasses.worn ? &*glasses.worn : nullptr, place.head);
      for (const double yaw : {0.0, 0.6}) {  // the second across a tile's change of main axis
        const glm::dvec3 gaze(std::sin(yaw), -0.2, -std::cos(yaw));
        const auto rays = rays_of(pair, support::view_along(pair, 0, render::Viewing::gaze, gaze, fov));
        std::vector<SceneRay> traced = rays;
        for (SceneRay& ray : traced) {
          if (ray.direction == glm::vec3(0.0F)) ray.direction = {0.0F, 0.0F, 1.0F};
        }
        const auto expected = embree.triangles_hit(traced);
        const auto is_rim = [](const SceneRay& ray) { return ray.direction == glm::vec3(0.0F); };
        const auto rims_here = static_cast<std::size_t>(std::ranges::count_if(rays, is_rim));
        rims += rims_here;
        pixels += rays.size() - rims_here;
        for (const auto& [traversal, name] : all_traversals()) {
          const auto hits = support::device_hits(device(), buffers, rays, kWidth, kHeight, traversal);
          std::size_t wrong_here = 0;
          for (std::size_t i = 0; i < rays.size(); ++i) {
            const bool same = is_rim(rays[i]) || same_hit(place.scene, rays[i], hits.triangle[i], expected[i]);
            wrong_here += same ? 0 : 1;
          }
          wrong[name] += wrong_here;
          handed_on[name] += traversal == Traversal::per_ray ? 0 : hits.left_out;
          std::cout << place.name << ", " << glasses.name << ", yaw " << yaw << ", " << name << ": " << wrong_here
                    << " differ, " << hits.left_out << " one by one of " << rays.size() << "\n";
        }
      }
    }
  }
  std::cout << pixels << " rays, " << rims << " rims\n";
  for (const auto& [traversal, name] : all_traversals()) {
    std::cout << name << ": " << wrong[name] << " differ from Embree, " << handed_on[name] << " handed on\n";
    EXPECT_LE(wrong[name], pixels / 100000) << name;
    EXPECT_LT(handed_on[name], pixels / 100) << name << " is left unused";
  }
  EXPECT_GT(rims, 1000U);
}

// Rays that fly apart - all of a picture's, or one in every other tile - are traced one by one, and tiles in which some
// have no ray at all are sound.
TEST(Traversals, HandOnWhatFliesApart) {
  const Scene scene = support::cluttered_room(5, 20000);
  const render::PacketTracer embree(scene);
  const render::SceneBuffers buffers(device(), scene);
  std::mt19937 random(21);
  std::normal_distribution<float> normal;
  const auto anywhere = [&] { return glm::normalize(glm::vec3(normal(random), normal(random), normal(random))); };
  for (const int stray_every : {1, 2 * 64}) {
    std::vector<SceneRay> rays;
    std::size_t strays = 0;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const int in_tiles = ((y / 8) * ((kWidth + 7) / 8) + x / 8) * 64 + (y % 8) * 8 + x % 8;
        const bool stray = in_tiles % stray_every == 0;
        strays += stray ? 1 : 0;
        const glm::vec3 ahead(static_cast<float>(x) / kWidth - 0.5F, static_cast<float>(y) / kHeight - 0.5F, -1.0F);
        const bool none = x % 7 == 3;
        rays.push_back({glm::vec3(0.01F * static_cast<float>(x % 5), 0.0F, 0.02F * static_cast<float>(y % 3)),
                        none ? glm::vec3(0.0F) : (stray ? anywhere() : glm::normalize(ahead))});
      }
    }
    std::vector<SceneRay> traced = rays;
    for (SceneRay& ray : traced) {
      if (ray.direction == glm::vec3(0.0F)) ray.direction = {0.0F, 0.0F, 1.0F};
    }
    const auto expected = embree.triangles_hit(traced);
    const auto hits = support::device_hits(device(), buffers, rays, kWidth, kHeight, Traversal::tile);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const bool none = rays[i].direction == glm::vec3(0.0F);
      wrong += none || same_hit(scene, rays[i], hits.triangle[i], expected[i]) ? 0 : 1;
    }
    EXPECT_LE(wrong, 2U);
    EXPECT_GT(hits.left_out, strays / 2);
    if (stray_every > 1) {
      EXPECT_LT(hits.left_out, rays.size() / 2);
    }
  }
}

// Triangles one behind the other, each a little larger than the one before, so that each hides the next and the tree is
// a chain: a tile at the outline has more waiting than its stack holds, and is handed on.
TEST(Traversals, HitTheFirstOfALongChain) {
  constexpr int kSide = 64, kTriangles = 4000;
  Scene chain;
  for (int i = 0; i < kTriangles; ++i) {
    const float x = std::exp2(static_cast<float>(i) * 50.0F / kTriangles - 22.0F);
    scene_oracle::add_triangle(chain, {x, 0.0F, 0.0F}, {x, 0.0F, 0.5F * x}, {x, 0.5F * x, 0.0F});
  }
  std::vector<SceneRay> rays;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      rays.push_back({glm::vec3(0.0F), glm::normalize(glm::vec3(1.0F, (static_cast<float>(x) + 0.5F) / kSide - 0.3F,
                                                                (static_cast<float>(y) + 0.5F) / kSide - 0.3F))});
    }
  }
  const auto expected = render::PacketTracer(chain).triangles_hit(rays);
  const render::SceneBuffers buffers(device(), chain);
  const auto hits = support::device_hits(device(), buffers, rays, kSide, kSide, Traversal::tile);
  std::size_t wrong = 0, met = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    wrong += same_hit(chain, rays[i], hits.triangle[i], expected[i]) ? 0 : 1;
    met += expected[i] == kNone ? 0 : 1;
  }
  EXPECT_EQ(wrong, 0U);
  EXPECT_GT(met, rays.size() / 20);
  EXPECT_GT(hits.left_out, 0U) << "the stack was never full";
  EXPECT_LT(hits.left_out, rays.size());
}

// To the bit, but where two triangles meet a ray within rounding of each other: either may win. A ray through an edge
// may pass it in one test and not in the other.
void expect_same_picture(const std::string& name, const render::RenderedFrame& expected,
                         const render::RenderedFrame& shown) {
  for (std::size_t v = 0; v < expected.views.size(); ++v) {
    const auto& a = expected.views[v].wavefront;
    const auto& b = shown.views[v].wavefront;
    std::size_t bits = 0, depths = 0;
    for (std::size_t i = 0; i < a.depth.size(); ++i) {
      const bool same = a.depth[i] == b.depth[i] && a.v_hh[i] == b.v_hh[i] && a.v_hv[i] == b.v_hv[i] &&
                        a.v_vv[i] == b.v_vv[i] && a.blur[i] == b.blur[i];
      bits += same ? 0 : 1;
      depths += std::abs(a.depth[i] - b.depth[i]) <= 1e-5F * std::abs(a.depth[i]) ? 0 : 1;
    }
    EXPECT_LE(bits, a.depth.size() / 2000);
    EXPECT_LE(depths, 1U);
    std::size_t shown_otherwise = 0;
    for (std::size_t i = 0; i < expected.views[v].radiance.size(); ++i) {
      const float x = expected.views[v].radiance[i], y = shown.views[v].radiance[i];
      shown_otherwise += std::abs(x - y) <= 2e-3F * (x + y) + 1e-4F ? 0 : 1;
    }
    std::cout << name << ": " << bits << " of " << a.depth.size() << " pixels differ in some bit, " << shown_otherwise
              << " are seen to\n";
    // An edge pixel's further rays may meet such a place too.
    EXPECT_LE(shown_otherwise, expected.views[v].radiance.size() / 1000);
  }
}

TEST(Traversals, MakeTheSamePicture) {
  render::FrameConfig config;
  config.width = kWidth;
  config.height = kHeight;
  config.keep_radiance = true;
  config.keep_wavefront = true;
  config.mode = render::Mode::pinhole;  // blur would spread one pixel's difference over its neighbours
  for (const Place& place : places()) {
    render::Renderer by_ray(device(), place.scene, {.traversal = Traversal::per_ray});
    std::map<std::string, render::Renderer> others;
    for (const auto& [traversal, name] : all_traversals()) {
      if (traversal == Traversal::per_ray) continue;
      others.emplace(name, render::Renderer(device(), place.scene, {.traversal = traversal}));
    }
    for (const Glasses& glasses : all_glasses()) {
      const auto pair = support::wear(lenses::Wearer{}, glasses.worn ? &*glasses.worn : nullptr, place.head);
      const auto fov = tracking::FieldOfView::symmetric(80.0 * support::kDegree, double{kWidth} / kHeight);
      const std::vector<render::ViewSetup> views{
          support::view_along(pair, 0, render::Viewing::gaze, {0.1, -0.1, -1.0}, fov),
          support::view_along(pair, 1, render::Viewing::gaze, {0.1, -0.1, -1.0}, fov)};
      const auto expected = by_ray.render(pair.model, views, config);
      for (auto& [name, renderer] : others) {
        SCOPED_TRACE(place.name + ", " + glasses.name + ", " + name);
        expect_same_picture(name, expected, renderer.render(pair.model, views, config));
      }
    }
  }
}

TEST(Traversals, RayQueriesAreRefusedWhereThereAreNone) {
  const Scene scene = scene_oracle::waves(3);
  if (device().limits().has_ray_query) {
    EXPECT_NO_THROW(render::Renderer(device(), scene, {.traversal = Traversal::ray_query}));
  } else {
    EXPECT_THROW(render::Renderer(device(), scene, {.traversal = Traversal::ray_query}), render::vk::DeviceError);
    EXPECT_THROW(static_cast<void>(render::vk::build_acceleration(device(), {})), std::invalid_argument);
  }
}

// What is measured once is read the next time, and obeyed.
TEST(Traversals, AutomaticKeepsToItsRecord) {
  // The same test may run beside this one with another driver.
  const auto file =
      std::filesystem::path(testing::TempDir()) / ("vergence_traversal_test_" + std::to_string(::getpid()) + ".txt");
  std::filesystem::remove(file);
  const Scene scene = scene_oracle::waves(30);
  const auto pair = support::wear(lenses::Wearer{}, nullptr, tracking::Pose{});
  const auto fov = tracking::FieldOfView::symmetric(60.0 * support::kDegree, 1.0);
  const auto view = support::view_along(pair, 0, render::Viewing::gaze, {0.0, -0.3, -1.0}, fov);
  render::FrameConfig config;
  config.width = config.height = 64;
  const auto traced_by = [&] {
    render::Renderer renderer(device(), scene, {.traversal = Traversal::automatic, .traversal_file = file});
    const auto frame = renderer.render(pair.model, {view}, config);
    for (const auto& [traversal, name] : all_traversals()) {
      if (std::ranges::find(frame.stages, name, &render::vk::StageTime::name) != frame.stages.end()) return traversal;
    }
    return Traversal::per_ray;
  };
  const Traversal first = traced_by();
  const render::TraversalRecord record(file, device().name());
  EXPECT_EQ(record.find(render::RayKind::bare), first);
  EXPECT_FALSE(record.find(render::RayKind::refracted));
  for (const auto& [traversal, name] : all_traversals()) {
    record.keep(render::RayKind::bare, traversal);
    EXPECT_EQ(traced_by(), traversal) << name;
  }
  // Another driver of the same name may have kept what this one cannot do.
  if (!device().limits().has_ray_query) {
    record.keep(render::RayKind::bare, Traversal::ray_query);
    EXPECT_NE(traced_by(), Traversal::ray_query);
    EXPECT_NE(record.find(render::RayKind::bare), Traversal::ray_query);
  }
  std::filesystem::remove(file);
}

}  // namespace
