// Scenes from a thousand triangles up to a million: what building their BVH takes in time and memory, printed, and held
// to growing as n log n and n.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <random>

#include "render/scene/bvh.hpp"
#include "render/scene/scene.hpp"

namespace {

// Small triangles anywhere in a cube of 10 m.
render::Scene scatter(std::size_t triangles) {
  render::Scene scene;
  scene.source = "scatter";
  scene.materials.emplace_back();
  std::mt19937 random(3);
  std::uniform_real_distribution<float> place(-5.0F, 5.0F), size(-0.05F, 0.05F);
  for (std::size_t i = 0; i < triangles; ++i) {
    const glm::vec3 p(place(random), place(random), place(random));
    const auto first = static_cast<std::uint32_t>(scene.vertices.size());
    for (int corner = 0; corner < 3; ++corner) {
      scene.vertices.push_back({p + glm::vec3(size(random), size(random), size(random)), {0, 1, 0}, {0, 0}});
    }
    scene.triangles.emplace_back(first, first + 1, first + 2);
    scene.triangle_material.push_back(0);
  }
  return scene;
}

TEST(GrowingScene, CostsAsExpected) {
#ifdef __SANITIZE_ADDRESS__
  constexpr std::size_t kLargest = 100'000;
#else
  constexpr std::size_t kLargest = 1'000'000;
#endif
  std::printf("%10s %10s %14s %14s %6s\n", "triangles", "build ms", "bytes", "bytes/triangle", "depth");
  double a_step = 0.0;  // seconds for each n log2 n of the scene of 10,000
  for (std::size_t n = 1000; n <= kLargest; n *= 10) {
    const render::Scene scene = scatter(n);
    const auto start = std::chrono::steady_clock::now();
    const render::Bvh4 bvh = render::build_bvh4(scene);
    const std::vector<render::ShadingTriangle> shading = render::shading_triangles(scene, bvh);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const std::size_t bytes = bvh.nodes.size() * sizeof(glm::uvec4) + bvh.triangles.size() * sizeof(glm::vec4) +
                              shading.size() * sizeof(render::ShadingTriangle);
    const double each = static_cast<double>(bytes) / static_cast<double>(n);
    std::printf("%10zu %10.1f %14zu %14.1f %6u\n", n, 1e3 * seconds, bytes, each, bvh.max_depth);
    EXPECT_EQ(shading.size(), n);
    // 48 + 64 bytes a triangle, and half a node of 64 bytes or little more.
    EXPECT_LT(each, 48.0 + 64.0 + 40.0);
    const double work = static_cast<double>(n) * std::log2(static_cast<double>(n));
    if (n == 10'000) a_step = seconds / work;
    // Caches and a busy machine are allowed a factor of eight; a quadratic build would take a hundred.
    if (n > 10'000) {
      EXPECT_LT(seconds, 8.0 * a_step * work) << n;
    }
  }
}

}  // namespace
