// Ctrl-C ends a session as its runtime would end it.
#pragma once

#include <array>
#include <csignal>

namespace app {

// While one lives, SIGINT and SIGTERM are only noted; there is one at a time.
class StopOnSignal {
 public:
  StopOnSignal();
  ~StopOnSignal();
  StopOnSignal(const StopOnSignal&) = delete;
  StopOnSignal& operator=(const StopOnSignal&) = delete;

  // Whether one came since the object was made.
  [[nodiscard]] static bool wanted();
  // As if one came; from any thread.
  static void stop();

 private:
  std::array<struct sigaction, 2> old_{};
};

}  // namespace app
