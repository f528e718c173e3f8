#include "tracking/saccade_detector.hpp"

#include <algorithm>
#include <vector>

#include "tracking/direction.hpp"

namespace tracking {
namespace {

constexpr std::size_t kMostSamples = 64;   // within a window, of a tracker as fast as 3 kHz
constexpr std::size_t kMostSpeeds = 128;   // about a second of a usual tracker
constexpr std::size_t kFewestSpeeds = 24;  // for a median that is worth more than the start's guess
// Of a speed whose two components are normal: the median is sqrt(2 ln 2) of their standard deviation (Rayleigh).
constexpr double kMedianOfRayleigh = 1.17741;
constexpr double kEndFraction = 0.5;  // of the threshold, below which a saccade is over
constexpr double kLongestGap = 0.1;   // s between samples, beyond which they say nothing about a speed

}  // namespace

void SaccadeDetector::restart() {
  samples_.clear();
  speed_ = 0.0;
  overlong_ = false;
  phase_ = GazePhase::fixation;
}

void SaccadeDetector::turn(const glm::dquat& new_from_old) {
  for (Sample& sample : samples_) {
    sample.direction = new_from_old * sample.direction;
  }
}

void SaccadeDetector::remember_speed() {
  speeds_.push_back(speed_);
  if (speeds_.size() > kMostSpeeds) {
    speeds_.pop_front();
  }
  if (speeds_.size() < kFewestSpeeds) {
    return;
  }
  std::vector<double> sorted(speeds_.begin(), speeds_.end());
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  threshold_ = std::max(config_.least_speed, config_.noise_multiple * *middle / kMedianOfRayleigh);
}

GazePhase SaccadeDetector::see(double time, const glm::dvec3& direction) {
  if (!samples_.empty() && !(time > samples_.back().time)) {
    return phase_;
  }
  if (!samples_.empty() && time - samples_.back().time > kLongestGap) {
    restart();
  }
  samples_.push_back({time, direction});
  while (samples_.size() > 2 && (time - samples_[1].time >= config_.window || samples_.size() > kMostSamples)) {
    samples_.pop_front();
  }
  if (samples_.size() < 2) {
    return phase_;
  }
  const Sample& before = samples_.front();
  // Over less than the window the noise would stand for more speed than the threshold knows of.
  speed_ = angle_between(before.direction, direction) / std::max(time - before.time, config_.window);
  if (phase_ == GazePhase::saccade) {
    overlong_ = time - began_ > config_.longest;
    if (overlong_ || speed_ < kEndFraction * threshold_) {
      phase_ = GazePhase::fixation;
    }
  } else if (speed_ > threshold_ && !overlong_) {
    phase_ = GazePhase::saccade;
    began_ = before.time;
  } else {
    overlong_ = overlong_ && speed_ > threshold_;
    remember_speed();
  }
  return phase_;
}

}  // namespace tracking
