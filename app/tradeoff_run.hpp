// The measurement of a trade-off: every setting drawn and timed in turns, and held against a converged reference.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/render_setup.hpp"
#include "app/tradeoff/tradeoff_row.hpp"
#include "render/image/image.hpp"
#include "render/ladder.hpp"
#include "render/scene/scene.hpp"

namespace app {

struct TradeoffConfig {
  SceneOptions scene;
  std::vector<render::Rung> rungs;  // at least one
  std::string accuracy;             // the rung that the advice begins with
  double threshold_px = 0.5, exposure = 0.0;
  std::uint32_t seed = 0;
  int rounds = 5;
  double most_seconds = 6.0;  // of one setting in all rounds; a slower one takes part in fewer of them
  int reference_samples = 1024;
  std::filesystem::path cache;        // folder of kept references; empty: none
  std::optional<double> target_rmse;  // absent: that of `accuracy`
  std::string device;
};

struct TradeoffResult {
  TradeoffReport report;
  render::Image8 reference;
  std::vector<render::Image8> pictures;  // one a row
};

// What is going on, and how much of it is done.
using TradeoffProgress = std::function<void(const std::string& what, int done, int of)>;

// Everything that the settings can be wrong about is said before anything is measured.
[[nodiscard]] TradeoffResult run_tradeoff(const TradeoffConfig& config, const render::Scene& scene,
                                          const TradeoffProgress& progress);

}  // namespace app
