// Whatever an order asks for within the allowed ranges, either method makes a finite surface that has the ordered
// powers at its two points, on either face, for either eye, on nets coarse and fine.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lenses/bspline_field.hpp"
#include "lenses/design/progressive.hpp"
#include "lenses/design/progressive_lens.hpp"
#include "tests/support/random_lens.hpp"
#include "tracking/input_error.hpp"

namespace {

using lenses::ProgressiveConfig;
using lenses::ProgressiveReport;
using support::Random;
using Method = ProgressiveConfig::Method;

constexpr std::uint64_t kSeed = 1963;

ProgressiveConfig random_config(Random& random) {
  ProgressiveConfig config;
  const auto one_in_two = [&] { return random.uniform(0.0, 1.0) < 0.5; };
  // Ends of the ranges are as likely as all between.
  const auto within = [&](double lo, double hi) {
    const double x = random.uniform(-0.25, 1.25);
    return lo + (hi - lo) * std::clamp(x, 0.0, 1.0);
  };
  config.face = one_in_two() ? ProgressiveConfig::Face::front : ProgressiveConfig::Face::eye_side;
  config.side = one_in_two() ? lenses::Side::right : lenses::Side::left;
  config.distance_power = config.face == ProgressiveConfig::Face::front ? within(0.0, 9.0) : within(-10.0, 2.0);
  config.addition = within(0.75, 3.5);
  config.corridor_length = within(0.008, 0.018);
  config.inset = within(0.0, 0.005);
  config.hardness = within(0.0, 1.0);
  config.index = within(1.45, 1.9);
  config.diameter = within(0.05, 0.075);
  config.fitting_cross = within(0.0, 0.006);
  config.distance_point = config.fitting_cross + within(0.0, 0.006);
  // A cell no wider than a sixth of the corridor, so that the net can follow it.
  const double coarsest = 3.0 + std::ceil(2.0 * config.half_width() / (config.corridor_length / 6.0));
  config.grid = static_cast<std::size_t>(within(std::max(24.0, coarsest), 70.0));
  return config;
}

void expect_finite(const lenses::ProgressiveDesign& design) {
  for (const double z : design.surface.control_z) ASSERT_TRUE(std::isfinite(z));
  const ProgressiveReport& r = design.report;
  for (const double value : {r.distance_power, r.near_power, r.peak_cylinder, r.peak_at.x, r.peak_at.y, r.minkwitz_y,
                             r.minkwitz_bound, r.minkwitz_reached, r.corridor_to_85_percent}) {
    EXPECT_TRUE(std::isfinite(value));
  }
}

TEST(ProgressiveRange, EveryOrderIsMet) {
  Random random(kSeed);
  int made = 0;
  for (int i = 0; i < 36; ++i) {
    ProgressiveConfig config = random_config(random);
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", order " << i << ": " << config.distance_power << " add "
                                    << config.addition << ", corridor " << config.corridor_length << ", inset "
                                    << config.inset << ", hardness " << config.hardness << ", grid " << config.grid
                                    << ", index " << config.index << ", diameter " << config.diameter << ", cross "
                                    << config.fitting_cross << ", distance " << config.distance_point);
    try {
      config.validate();
    } catch (const tracking::InputError& error) {
      EXPECT_EQ(error.field(), "diameter");  // too steep for its width
      continue;
    }
    ++made;
    const lenses::ProgressiveDesign design = lenses::design_progressive(config);
    expect_finite(design);
    EXPECT_NEAR(design.report.distance_power, config.distance_power, 0.02);
    EXPECT_NEAR(design.report.addition(), config.addition, 0.02);
    EXPECT_GT(design.report.corridor_to_85_percent, 0.4 * config.corridor_length);
    EXPECT_LT(design.report.corridor_to_85_percent, std::hypot(config.corridor_length, config.inset));
    EXPECT_GT(design.report.peak_cylinder, 0.4 * config.addition);
    EXPECT_LT(design.report.peak_cylinder, 2.0 * config.addition);

    config.method = Method::closed_form;
    const lenses::ProgressiveDesign closed = lenses::design_progressive(config);
    expect_finite(closed);
    // Sampled and fitted, nothing corrects it; 0.06 D is half of what standards allow an addition.
    EXPECT_NEAR(closed.report.addition(), config.addition, 0.06);
    EXPECT_NEAR(closed.report.distance_power, config.distance_power, 0.06);
  }
  EXPECT_GE(made, 24);
}

// Finished lenses of any order: made, or refused for a reason that names a field of the request; never half made.
TEST(ProgressiveRange, EveryLensIsMadeOrRefusedByName) {
  Random random(kSeed + 1);
  int made = 0;
  for (int i = 0; i < 30; ++i) {
    lenses::ProgressiveLensRequest request;
    request.surface = random_config(random);
    request.surface.grid = 30;
    request.surface.method = i % 2 == 0 ? Method::closed_form : Method::variational;
    request.sphere = random.uniform(-12.0, 8.0);
    request.addition = request.surface.addition;
    SCOPED_TRACE(testing::Message() << "seed " << kSeed + 1 << ", order " << i << ": " << request.sphere << " add "
                                    << request.addition);
    try {
      const lenses::ProgressiveLens lens = lenses::make_progressive_lens(request);
      ++made;
      EXPECT_NEAR(lens.distance_reading, request.sphere, 1e-6);
      EXPECT_NEAR(lens.addition_reading, request.addition, 0.01);
      EXPECT_GE(lens.thinnest_edge, request.minimum_edge_thickness);
    } catch (const tracking::InputError& error) {
      EXPECT_TRUE(error.field() == "base_curve" || error.field() == "diameter" || error.field() == "sphere")
          << error.what();
      EXPECT_GT(request.sphere, 3.0) << error.what();  // an ordinary lens is no trouble
    }
  }
  EXPECT_GE(made, 22);
}

}  // namespace
