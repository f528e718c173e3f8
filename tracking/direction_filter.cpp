#include "tracking/direction_filter.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "tracking/direction.hpp"

namespace tracking {
namespace {

// The weight of a sample that stands for `interval`: what a first-order low pass takes over in that time.
double weight(double cutoff, double interval) {
  return -std::expm1(-2.0 * std::numbers::pi * cutoff * interval);
}

// After a gap a sample stands for no longer than this: it is one measurement, as noisy as any.
constexpr double kLongestInterval = 0.05;  // s

}  // namespace

glm::dvec3 DirectionFilter::see(double time, const glm::dvec3& direction) {
  if (value_ && samples_ > 0 && !(time > time_)) {
    return *value_;
  }
  if (!value_ || samples_ == 0) {
    value_ = direction;
    velocity_ = glm::dvec3(0.0);
  } else {
    const double interval = std::min(time - time_, kLongestInterval);
    // A chord for an arc: within 1 % up to 28 degrees between samples, beyond which the cutoff is high anyway.
    const glm::dvec3 speed = (direction - last_) / (time - time_);
    velocity_ += weight(config_.speed_cutoff, interval) * (speed - velocity_);
    const double cutoff = config_.rest_cutoff + config_.speed_slope * glm::length(velocity_);
    const double average = 1.0 / (samples_ + 1.0);
    value_ = turned_towards(*value_, direction, std::max(weight(cutoff, interval), average));
  }
  last_ = direction;
  time_ = time;
  samples_ = std::min(samples_ + 1, 1 << 20);
  return *value_;
}

void DirectionFilter::turn(const glm::dquat& new_from_old) {
  if (value_) {
    value_ = new_from_old * *value_;
  }
  last_ = new_from_old * last_;
  velocity_ = new_from_old * velocity_;
}

}  // namespace tracking
