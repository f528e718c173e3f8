// What leaving out a headset's hidden pixels saves: mask_bench [SIZE [ROUNDS [GUARD]]]. Both eyes of a running picture
// of the reading room, bare adof through B-spline/sphere; without a mask, with one that hides nothing, with corners as
// Monado's simulated headset hides them, and with all but a disc.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <string>

#include "render/live_frame.hpp"
#include "tests/support/worn_views.hpp"

namespace {

using render::LiveFrame;
using tracking::FieldOfView;
using tracking::HiddenArea;

constexpr FieldOfView kField{0.916331, 0.916331, 0.986818, 0.986818};  // Monado's simulated headset

HiddenArea corners() {
  const double x = kField.tan_right, y = kField.tan_up;
  HiddenArea area;
  for (const double across : {-1.0, 1.0}) {
    for (const double up : {-1.0, 1.0}) {
      area.triangles.push_back({glm::dvec2(across * x, up * 0.75 * y), glm::dvec2(across * x, up * y),
                                glm::dvec2(across * 0.75 * x, up * y)});
    }
  }
  return area;
}

HiddenArea around_disc(double radius) {
  constexpr int kParts = 48;
  HiddenArea area;
  const auto at = [&](int i, double r) {
    return r * glm::dvec2(std::cos(2.0 * M_PI * i / kParts), std::sin(2.0 * M_PI * i / kParts));
  };
  for (int i = 0; i < kParts; ++i) {
    area.triangles.push_back({at(i, radius), at(i, 3.0), at(i + 1, 3.0)});
    area.triangles.push_back({at(i, radius), at(i + 1, 3.0), at(i + 1, radius)});
  }
  return area;
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

struct Kind {
  std::string name;
  std::unique_ptr<LiveFrame> live;
  std::map<std::string, std::vector<double>> ms;
};

}  // namespace

int main(int argc, char** argv) {
  const int side = argc > 1 ? std::atoi(argv[1]) : 512;
  const int rounds = argc > 2 ? std::atoi(argv[2]) : 7;
  const int guard = argc > 3 ? std::atoi(argv[3]) : 0;
  const render::Scene scene = support::reading_room();
  render::vk::Device device;
  render::Renderer renderer(device, scene, {.traversal = render::Traversal::tile});
  const lenses::Spectacles glasses =
      lenses::read_spectacles(VERGENCE_ASSETS "/spectacles/presbyopia_bspline_sphere.json");
  lenses::Wearer wearer;
  wearer.age = 60.0;
  const auto pair = support::wear(
      wearer, &glasses,
      {glm::dquat(1.0, 0.0, 0.0, 0.0), support::target_position(scene, "near_card") + glm::dvec3(0.0, 0.2, 0.4)});
  const auto views =
      support::views_at(pair, render::Viewing::gaze, support::target_position(scene, "near_card"), kField);
  render::LiveConfig config;
  config.frame.width = config.frame.height = side;
  config.frame.bare = std::getenv("VERGENCE_BENCH_FULL") == nullptr;
  config.guard_px = guard;
  std::vector<Kind> kinds;
  const auto add = [&](const char* name, const std::optional<HiddenArea>& area) {
    config.hidden = area ? std::optional(std::vector<HiddenArea>(2, *area)) : std::nullopt;
    kinds.push_back(
        {name,
         std::make_unique<LiveFrame>(renderer, pair.model, views, config, std::vector<std::vector<VkImage>>(2)),
         {}});
  };
  add("no mask", std::nullopt);
  add("empty mask", HiddenArea{});
  add("corners", corners());
  add("disc 0.98", around_disc(0.98));
  for (int round = 0; round < rounds + 2; ++round) {
    for (Kind& kind : kinds) {
      kind.live->start(pair.model, views, {});
      double sum = 0.0;
      for (const render::vk::StageTime& stage : kind.live->wait()) {
        sum += stage.milliseconds;
        if (round > 1) {
          kind.ms[stage.name].push_back(stage.milliseconds);
        }
      }
      if (round > 1) {
        kind.ms["frame"].push_back(sum);
      }
    }
  }
  for (const Kind& kind : kinds) {
    std::printf("%-12s hidden %5.1f %%, left out %5.1f %%:", kind.name.c_str(), 100.0 * kind.live->hidden_fraction(),
                100.0 * kind.live->left_out_fraction());
    for (const auto& [stage, times] : kind.ms) {
      std::printf("  %s %.2f", stage.c_str(), median(times));
    }
    std::printf("\n");
  }
}
