// The 1 Euro filter (Casiez, Roussel and Vogel 2012) for directions: it steps along great circles, and its smoothing is
// exponential in time, so that irregular samples weigh by the time they stand for.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "tracking/live_config.hpp"

namespace tracking {

class DirectionFilter {
 public:
  explicit DirectionFilter(const OneEuroConfig& config = {}) : config_(config) {}

  // A unit direction at a time later than the last; one that is not later leaves the value as it is.
  glm::dvec3 see(double time, const glm::dvec3& direction);

  // The direction is known to have jumped: the next sample is taken as it is, and those behind it are averaged until
  // they are as many as the filter remembers.
  void restart() { samples_ = 0; }

  // All directions so far are to be seen in axes that have turned.
  void turn(const glm::dquat& new_from_old);

  [[nodiscard]] const std::optional<glm::dvec3>& value() const { return value_; }

 private:
  OneEuroConfig config_;
  std::optional<glm::dvec3> value_;
  glm::dvec3 last_{0.0, 0.0, -1.0};  // the last sample
  glm::dvec3 velocity_{0.0};         // rad/s, filtered
  double time_ = 0.0;
  int samples_ = 0;  // since the restart
};

}  // namespace tracking
