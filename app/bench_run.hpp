// The benchmark's measurement: each lens in each mode and size, timed in turns over several rounds, beside Embree on
// the same rays.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/bench/bench_report.hpp"
#include "app/render_setup.hpp"
#include "render/accuracy.hpp"
#include "render/scene/scene.hpp"
#include "render/traversal.hpp"

namespace app {

struct BenchLens {
  std::string name;        // as the rows call it
  std::string spectacles;  // a file, or none
};

struct BenchConfig {
  std::vector<BenchLens> lenses;
  std::vector<std::string> modes, shadings;  // of kBenchModes and kBenchShadings; not empty
  std::vector<int> sizes;                    // px along each side
  int rounds = 3;
  SceneOptions scene;  // its spectacles, eye and size do not count
  double threshold_px = 0.5;
  double exposure = 0.0;
  render::Accuracy accuracy;
  std::uint32_t seed = 0;
  std::string device;
  render::Traversal traversal = render::Traversal::automatic;
};

// Called before a frame of a round; round 0 does not count.
using BenchProgress = std::function<void(const BenchRow& row, int round)>;

// Everything that the settings can be wrong about is said before anything is measured.
[[nodiscard]] BenchReport run_bench(const BenchConfig& config, const render::Scene& scene,
                                    const BenchProgress& progress);

}  // namespace app
