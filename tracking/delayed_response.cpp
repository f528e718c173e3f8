#include "tracking/delayed_response.hpp"

#include <cmath>

namespace tracking {
namespace {

// Commands nearer in time than this are one: a bound on how many can be pending.
constexpr double kLeastSpacing = 1e-4;  // s

}  // namespace

void DelayedResponse::follow(double interval) {
  // A first-order lag does not overshoot, so the direction holds for the whole interval.
  const double time_constant = goal_ > value_ ? config_.time_constant_up : config_.time_constant_down;
  value_ = time_constant > 0.0 ? goal_ + (value_ - goal_) * std::exp(-interval / time_constant) : goal_;
}

double DelayedResponse::step(double time, double command) {
  if (!std::isfinite(time) || (started_ && time < time_)) {
    return value_;
  }
  if (!started_) {
    started_ = true;
    time_ = time;
  }
  while (!pending_.empty() && pending_.front().effective <= time) {
    follow(pending_.front().effective - time_);
    time_ = pending_.front().effective;
    goal_ = pending_.front().goal;
    pending_.pop_front();
  }
  follow(time - time_);
  time_ = time;
  const double last = pending_.empty() ? goal_ : pending_.back().goal;
  if (std::isfinite(command) && command != last) {
    const double effective = time + config_.latency;
    if (!pending_.empty() && effective - pending_.back().effective < kLeastSpacing) {
      pending_.back().goal = command;
    } else {
      pending_.push_back({effective, command});
    }
  }
  return value_;
}

}  // namespace tracking
