#include "app/vr/stop_signal.hpp"

#include <atomic>

namespace app {
namespace {

std::atomic<bool> g_stop = false;  // the signal's thread need not be the session's
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may not take a lock");

}  // namespace

StopOnSignal::StopOnSignal() {
  g_stop = false;
  struct sigaction action {};
  action.sa_handler = [](int) { g_stop = true; };
  ::sigaction(SIGINT, &action, &old_[0]);
  ::sigaction(SIGTERM, &action, &old_[1]);
}

StopOnSignal::~StopOnSignal() {
  ::sigaction(SIGINT, &old_[0], nullptr);
  ::sigaction(SIGTERM, &old_[1], nullptr);
}

bool StopOnSignal::wanted() {
  return g_stop;
}

void StopOnSignal::stop() {
  g_stop = true;
}

}  // namespace app
