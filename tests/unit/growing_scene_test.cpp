// Scenes from a thousand triangles up to four million: what building their trees takes in processor time and memory,
// and what a ray costs in them, printed, and held to growing as n log n, n and log n.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <cstdio>
#include <ctime>

#include "render/scene/bvh.hpp"
#include "tests/support/fine_waves.hpp"
#include "tests/support/scene_oracle.hpp"

namespace {

// Of this process, all threads together: what else the machine does is no part of it.
double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double peak_mebibytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

// Texels that a ray reads on its way to what it hits, on average of rays all around the lower half.
double fetches_a_ray(const render::Bvh4& bvh) {
  constexpr int kSide = 100;
  scene_oracle::shader::fetches = 0;
  int hits = 0;
  for (int i = 0; i < kSide * kSide; ++i) {
    const double height = -(i / kSide + 0.5) / kSide, around = 2.0 * glm::pi<double>() * (i % kSide + 0.5) / kSide;
    const double flat = std::sqrt(1.0 - height * height);
    const glm::dvec3 direction(flat * std::cos(around), height, flat * std::sin(around));
    hits += scene_oracle::trace(bvh, glm::vec3(0.0F), glm::vec3(direction)) ? 1 : 0;
  }
  EXPECT_GT(hits, kSide * kSide / 2);
  return static_cast<double>(scene_oracle::shader::fetches) / (kSide * kSide);
}

TEST(GrowingScene, CostsAsExpected) {
#ifdef __SANITIZE_ADDRESS__
  constexpr std::size_t kLargest = 100'000;
#else
  constexpr std::size_t kLargest = 4'000'000;
#endif
  std::printf("%10s %12s %12s %9s %6s %12s %14s\n", "triangles", "build cpu ms", "MiB", "B/triangle", "depth",
              "texels a ray", "peak MiB so far");
  double a_step = 0.0, first_fetches = 0.0;
  for (const std::size_t wanted : {1'000UL, 10'000UL, 100'000UL, 1'000'000UL, 4'000'000UL}) {
    if (wanted > kLargest) break;
    const render::Scene scene = support::fine_waves(wanted);
    const auto n = static_cast<double>(scene.triangles.size());
    const double start = processor_seconds();
    const render::SceneBvh bvh = render::build_scene_bvh(scene);
    const std::vector<render::ShadingTriangle> shading = render::shading_triangles(scene, bvh.four);
    const double seconds = processor_seconds() - start;
    const auto bytes = static_cast<double>((bvh.four.nodes.size() + bvh.eight.nodes.size()) * sizeof(glm::uvec4) +
                                           bvh.four.triangles.size() * sizeof(glm::vec4) +
                                           shading.size() * sizeof(render::ShadingTriangle));
    const double fetches = fetches_a_ray(bvh.four);
    std::printf("%10.0f %12.1f %12.1f %9.1f %6u %12.1f %14.0f\n", n, 1e3 * seconds, bytes / 0x1p20, bytes / n,
                bvh.four.max_depth, fetches, peak_mebibytes());
    EXPECT_EQ(shading.size(), scene.triangles.size());
    // 48 + 64 bytes a triangle, and 48 at most for its part of both trees' nodes.
    EXPECT_LT(bytes / n, 48.0 + 64.0 + 48.0);
    const double work = n * std::log2(n);
    // Caches are allowed a factor of four; a quadratic build would take four hundred.
    if (wanted == 10'000) a_step = seconds / work;
    if (wanted > 10'000) {
      EXPECT_LT(seconds, 4.0 * a_step * work) << n;
    }
    // Each level of the tree divides what is left by four; a quarter more than log n is for hills that grow finer.
    if (first_fetches == 0.0) first_fetches = fetches / std::log2(n);
    EXPECT_LT(fetches, 1.25 * first_fetches * std::log2(n)) << n;
  }
  // The scene, the builder's scratch and its result, all at once.
  EXPECT_LT(peak_mebibytes(), 1536.0);
}

}  // namespace
