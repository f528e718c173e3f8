// The display's rate held on simulated loads, without judder between two rungs.
#include "render/governor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>
#include <limits>
#include <numbers>
#include <random>

namespace {

using render::Governor;
using render::GovernorConfig;
using render::GovernorRung;

constexpr double kPeriod = 1.0 / 90.0;
constexpr std::uint64_t kSeed = 90;

std::vector<GovernorRung> four_rungs() {
  return {{"a", {}, 1.0}, {"b", {}, 0.7}, {"c", {}, 0.5}, {"d", {}, 0.3}};
}

struct Course {
  int switches = 0, late = 0;
  std::size_t last = 0;
  std::vector<std::size_t> rung;  // of each frame
};

// load: what a frame at the finest rung takes, in periods, at a time. truth: what the rungs cost indeed. Measurements
// come in `lag` frames after the rung was chosen, as a pipeline has it.
Course simulate(double seconds, const std::function<double(double)>& load,
                const std::vector<double>& truth = {1.0, 0.7, 0.5, 0.3}, int lag = 2, GovernorConfig config = {}) {
  config.period = kPeriod;
  Governor governor(config, four_rungs());
  std::deque<std::pair<std::size_t, double>> under_way;
  Course run;
  for (int i = 0; i * kPeriod < seconds; ++i) {
    const double time = i * kPeriod;
    const double took = load(time) * truth[governor.rung()] * kPeriod;
    run.late += took > kPeriod ? 1 : 0;
    run.rung.push_back(governor.rung());
    under_way.emplace_back(governor.rung(), took);
    if (static_cast<int>(under_way.size()) > lag) {
      governor.see(time, under_way.front().first, under_way.front().second);
      under_way.pop_front();
    }
  }
  run.switches = governor.switches();
  run.last = governor.rung();
  return run;
}

TEST(Governor, AFrameThatFitsChangesNothing) {
  const Course run = simulate(60.0, [](double) { return 0.85; });
  EXPECT_EQ(run.switches, 0);
  EXPECT_EQ(run.last, 0U);
}

TEST(Governor, AStepOfLoadIsMetAtOnceAndForGood) {
  for (const auto& [load, rung] :
       std::vector<std::pair<double, std::size_t>>{{1.05, 1}, {1.5, 2}, {2.5, 3}, {9.0, 3}}) {
    const Course run = simulate(30.0, [load = load](double t) { return t < 1.0 ? 0.5 : load; });
    EXPECT_EQ(run.switches, 1) << load << ": straight to the rung that fits";
    EXPECT_EQ(run.last, rung) << load;
    if (load < 3.0) {
      // Three late frames, and those under way meanwhile.
      EXPECT_LE(run.late, 3 + 2 + 1) << load;
    }
  }
}

TEST(Governor, ASingleSlowFrameIsNoLoad) {
  int frame = 0;
  const Course run = simulate(60.0, [&](double) { return ++frame % 40 == 0 ? 4.0 : 0.8; });
  EXPECT_EQ(run.switches, 0);
}

TEST(Governor, ItComesBackRungByRung) {
  const Course run = simulate(40.0, [](double t) { return t > 5.0 && t < 8.0 ? 2.5 : 0.5; });
  EXPECT_EQ(run.last, 0U);
  EXPECT_EQ(run.switches, 4);  // to the coarsest, and three steps back
  // Not before the dwell, and each step after another one.
  const auto first = std::ranges::find(run.rung, 3U) - run.rung.begin();
  const auto back = std::ranges::find(run.rung.begin() + first, run.rung.end(), 2U) - run.rung.begin();
  EXPECT_GE(static_cast<double>(back - first) * kPeriod, 3.0);
  EXPECT_LE(static_cast<double>(back - first) * kPeriod, 4.5);
}

// At every border between two rungs, and in noise across it: at most 4 changes in 2 minutes.
TEST(Governor, NoJudderAtABorder) {
  for (double mean = 0.6; mean < 3.0; mean *= 1.08) {
    for (const double sigma : {0.0, 0.05, 0.2}) {
      std::mt19937_64 random(kSeed);
      std::normal_distribution<double> noise(0.0, 1.0);
      const Course run = simulate(120.0, [&](double) { return mean * std::exp(sigma * noise(random)); });
      EXPECT_LE(run.switches, 4) << "mean " << mean << ", sigma " << sigma << ", seed " << kSeed;
    }
  }
}

// A load that swings across the border: each move to a finer rung that proves a mistake is waited for twice as long.
TEST(Governor, SwingsAreAnsweredEverMoreSlowly) {
  for (const double swing_period : {2.0, 5.0, 9.0}) {
    const Course run =
        simulate(600.0, [&](double t) { return 0.75 + 0.4 * std::sin(2.0 * std::numbers::pi * t / swing_period); });
    // Doubling from 1 s to 60 s takes 6 pairs of changes, and then one pair a minute for the other 8 minutes; a pair
    // more for each step through a rung between.
    EXPECT_LE(run.switches, 2 * (6 + 9) + 12) << swing_period << " s";
    EXPECT_LT(run.late, static_cast<int>(0.05 * static_cast<double>(run.rung.size()))) << swing_period << " s";
  }
}

// The prediction says that the finer rung costs little more; it costs the double.
TEST(Governor, AWrongPredictionIsLearnt) {
  const Course run = simulate(300.0, [](double t) { return t < 1.0 ? 1.3 : 1.2; }, {1.0, 0.4, 0.35, 0.3});
  EXPECT_GE(run.last, 1U);
  EXPECT_LE(run.switches, 4);
}

TEST(Governor, FramesOfAnotherRungAndNonsenseArePassedOver) {
  Governor governor({.period = kPeriod}, four_rungs());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < 100; ++i) {
    governor.see(i * kPeriod, 2, 10.0);
    governor.see(i * kPeriod, 0, nan);
    governor.see(nan, 0, 10.0);
    governor.see(i * kPeriod, 0, -1.0);
    governor.see(i * kPeriod, 0, 0.0);
  }
  EXPECT_EQ(governor.switches(), 0);
  EXPECT_EQ(governor.reason(), "the start");
  for (int i = 0; i < 3; ++i) governor.see(2.0 + i * kPeriod, 0, 1.1 * kPeriod);
  EXPECT_EQ(governor.current().name, "b");
  EXPECT_EQ(governor.reason(), "3 frames took 12.2 of 11.1 ms");
}

TEST(Governor, OneRungIsKeptWhateverItCosts) {
  Governor governor({.period = kPeriod}, {{"only", {}, 1.0}});
  for (int i = 0; i < 1000; ++i) governor.see(i * kPeriod, 0, 5.0 * kPeriod);
  EXPECT_EQ(governor.switches(), 0);
  EXPECT_THROW(Governor({}, {}), std::invalid_argument);
  EXPECT_THROW(Governor({}, {{"free", {}, 0.0}}), std::invalid_argument);
}

TEST(GovernorRungs, AreTheLaddersAndItsLastAtLowerResolutions) {
  const std::string_view names[] = {"standard"};
  const double costs[] = {1.0}, resolutions[] = {0.8, 0.5};
  const auto rungs = render::governor_rungs(names, costs, resolutions);
  ASSERT_EQ(rungs.size(), 3U);
  EXPECT_EQ(rungs[0].name, "standard");
  EXPECT_EQ(rungs[2].name, "standard at 50 %");
  EXPECT_EQ(rungs[2].accuracy.resolution, 0.5);
  EXPECT_NEAR(rungs[2].cost, 0.1 + 0.9 * 0.25, 1e-12);
  const std::string_view unknown[] = {"no such rung"};
  EXPECT_THROW(static_cast<void>(render::governor_rungs(unknown, costs, resolutions)), std::invalid_argument);
}

}  // namespace
