#include "app/vr/stop_signal.hpp"

namespace app {
namespace {

volatile std::sig_atomic_t g_stop = 0;

}  // namespace

StopOnSignal::StopOnSignal() {
  g_stop = 0;
  struct sigaction action {};
  action.sa_handler = [](int) { g_stop = 1; };
  ::sigaction(SIGINT, &action, &old_[0]);
  ::sigaction(SIGTERM, &action, &old_[1]);
}

StopOnSignal::~StopOnSignal() {
  ::sigaction(SIGINT, &old_[0], nullptr);
  ::sigaction(SIGTERM, &old_[1], nullptr);
}

bool StopOnSignal::wanted() {
  return g_stop != 0;
}

}  // namespace app
