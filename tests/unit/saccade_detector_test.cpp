// What counts as a saccade in noise, in pursuit, and where samples come as they like.
#include "tracking/saccade_detector.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/support/eye_movement.hpp"

namespace {

using tracking::GazePhase;
using tracking::SaccadeDetector;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr std::uint64_t kSeed = 1996;

class Eye {
 public:
  explicit Eye(double noise_deg) : noise_(0.0, noise_deg), silent_(noise_deg == 0.0) {}
  glm::dvec3 at(double yaw_deg) {
    const double u = silent_ ? 0.0 : noise_(random_), v = silent_ ? 0.0 : noise_(random_);
    return tracking::direction_from_yaw_pitch((yaw_deg + u) * kDegree, v * kDegree);
  }

 private:
  std::mt19937_64 random_{kSeed};
  std::normal_distribution<double> noise_;
  bool silent_;
};

TEST(SaccadeDetector, FindsEachSaccadeOnce) {
  for (const double rate : {60.0, 90.0, 120.0, 250.0, 1000.0}) {
    Eye eye(0.05);
    SaccadeDetector detector;
    int saccades = 0;
    double yaw = 0.0;
    GazePhase last = GazePhase::fixation;
    // Every 0.4 s, of 2 to 20 degrees, to and fro.
    support::Saccade saccade{0.0, -1.0};
    double direction = 1.0;
    for (int i = 0; i < 10.0 * rate; ++i) {
      const double time = i / rate;
      const int turn = static_cast<int>(time / 0.4);
      if (turn > 0 && saccade.start != 0.4 * turn) {
        yaw += direction * saccade.amplitude_deg;
        direction = -direction;
        saccade = {2.0 + (turn * 5) % 19, 0.4 * turn};
      }
      const GazePhase phase = detector.see(time, eye.at(yaw + direction * saccade.angle_deg(time)));
      saccades += phase == GazePhase::saccade && last != phase ? 1 : 0;
      last = phase;
    }
    EXPECT_EQ(saccades, 24) << rate << " Hz, seed " << kSeed;
  }
}

TEST(SaccadeDetector, NoiseAloneIsNone) {
  for (const double rate : {60.0, 90.0, 250.0}) {
    for (const double noise : {0.02, 0.3, 1.0}) {
      Eye eye(noise);
      SaccadeDetector detector;
      int in_saccade = 0;
      for (int i = 0; i < 120.0 * rate; ++i) {
        // Noise above what a start expects needs the first samples to be known.
        in_saccade += detector.see(i / rate, eye.at(0.0)) == GazePhase::saccade && i > 100 ? 1 : 0;
      }
      EXPECT_EQ(in_saccade, 0) << rate << " Hz, noise " << noise << " deg, seed " << kSeed;
      // Two samples' noise over the first interval that is no shorter than the window, six times; the median of 128
      // speeds is good to 10 %.
      const double interval = std::ceil(0.02 * rate - 1e-9) / rate;
      const double expected = std::max(30.0, 6.0 * noise * std::numbers::sqrt2 / interval);
      EXPECT_NEAR(detector.threshold() / kDegree, expected, 0.25 * expected);
    }
  }
}

TEST(SaccadeDetector, PursuitIsNoSaccade) {
  Eye eye(0.1);
  SaccadeDetector detector;
  for (int i = 0; i < 900; ++i) {
    const double time = i / 90.0;
    EXPECT_EQ(detector.see(time, eye.at(25.0 * time)), GazePhase::fixation) << time;
  }
}

TEST(SaccadeDetector, AMovementWithoutEndIsNone) {
  SaccadeDetector detector;
  int in_saccade = 0;
  for (int i = 0; i < 200; ++i) {
    const double time = i * 0.01;
    in_saccade += detector.see(time, tracking::direction_from_yaw_pitch(5.0 * time, 0.0)) == GazePhase::saccade;
  }
  EXPECT_GT(in_saccade, 5);
  EXPECT_LE(in_saccade, 16);  // 0.15 s
  EXPECT_EQ(detector.phase(), GazePhase::fixation);
}

TEST(SaccadeDetector, SamplesAsTheyCome) {
  SaccadeDetector detector;
  const auto at = [](double yaw) { return tracking::direction_from_yaw_pitch(yaw * kDegree, 0.0); };
  for (int i = 0; i < 50; ++i) {
    EXPECT_EQ(detector.see(i * 0.011, at(0.0)), GazePhase::fixation);
    EXPECT_EQ(detector.see(i * 0.011, at(20.0)), GazePhase::fixation) << "the same time again";
    EXPECT_EQ(detector.see(i * 0.011 - 0.5, at(20.0)), GazePhase::fixation) << "an older one";
  }
  // A gap says nothing about speed.
  EXPECT_EQ(detector.see(5.0, at(20.0)), GazePhase::fixation);
  EXPECT_EQ(detector.see(5.011, at(20.0)), GazePhase::fixation);
  // Two samples of nearly the same time do not make a speed of their noise.
  EXPECT_EQ(detector.see(5.0110001, at(20.3)), GazePhase::fixation);
  EXPECT_EQ(detector.see(5.03, at(26.0)), GazePhase::saccade);
}

}  // namespace
