// How an eye moves and what a tracker makes of it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include "tracking/gaze_follower.hpp"

namespace support {

// A saccade of so many degrees takes 2.2 ms a degree and 21 ms (the main sequence; Carpenter 1988), on the course of
// least jerk.
struct Saccade {
  double amplitude_deg;
  double start;  // s

  [[nodiscard]] double duration() const { return 0.0022 * amplitude_deg + 0.021; }
  [[nodiscard]] double end() const { return start + duration(); }
  [[nodiscard]] double angle_deg(double time) const {
    const double t = std::clamp((time - start) / duration(), 0.0, 1.0);
    return amplitude_deg * t * t * t * (10.0 - 15.0 * t + 6.0 * t * t);
  }
};

// Samples a second of one combined direction, with white noise of so many degrees rms on each of its two axes.
class Tracker {
 public:
  Tracker(double rate, double noise_deg, std::uint64_t seed)
      : rate_(rate), noise_(0.0, noise_deg * std::numbers::pi / 180.0), silent_(noise_deg == 0.0), random_(seed) {}

  [[nodiscard]] double time(int i) const { return i / rate_; }
  [[nodiscard]] tracking::GazeSample sample(int i, double yaw_deg, double pitch_deg = 0.0) {
    constexpr double kRadians = std::numbers::pi / 180.0;
    const double u = silent_ ? 0.0 : noise_(random_);
    const double v = silent_ ? 0.0 : noise_(random_);
    tracking::GazeSample s;
    s.time = time(i);
    s.combined =
        tracking::Line{{}, tracking::direction_from_yaw_pitch(yaw_deg * kRadians + u, pitch_deg * kRadians + v)};
    return s;
  }

 private:
  double rate_;
  std::normal_distribution<double> noise_;
  bool silent_;
  std::mt19937_64 random_;
};

}  // namespace support
