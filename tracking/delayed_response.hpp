// A quantity that follows a command after a latency, as a first-order lag: exact for commands that hold from one call
// to the next, so the state at a time does not depend on how many frames led there.
#pragma once

#include <deque>

namespace tracking {

class DelayedResponse {
 public:
  struct Config {
    double latency = 0.0;                                       // s
    double time_constant_up = 0.25, time_constant_down = 0.25;  // s, towards larger and smaller values; 0: at once
  };

  // At rest at a value.
  DelayedResponse(const Config& config, double value) : config_(config), value_(value), goal_(value) {}

  // The value at `time`; from then on `command` holds. A time that is not finite or lies before the last changes
  // nothing; a command that is not finite leaves the last one in force.
  double step(double time, double command);

  [[nodiscard]] double value() const { return value_; }

 private:
  struct Command {
    double effective;  // s, when it arrives
    double goal;
  };

  void follow(double interval);

  Config config_;
  double value_, goal_;
  std::deque<Command> pending_;
  bool started_ = false;
  double time_ = 0.0;
};

}  // namespace tracking
