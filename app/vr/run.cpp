#include "app/vr/run.hpp"

#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>
#include <thread>

#include "app/vr/connection.hpp"
#include "app/vr/stop_signal.hpp"
#include "app/vr/world.hpp"

namespace app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kBetweenTries{500};

// A runtime that is started again takes its time; how it fails meanwhile says nothing. Null where none came in time, or
// the user has had enough.
std::unique_ptr<VrConnection> wait_for_runtime(VrWorld& world, Clock::time_point until) {
  while (Clock::now() < until && !StopOnSignal::wanted()) {
    try {
      return std::make_unique<VrConnection>(world);
    } catch (const xr::Error&) {
      std::this_thread::sleep_for(std::min<Clock::duration>(kBetweenTries, until - Clock::now()));
    }
  }
  return nullptr;
}

}  // namespace

VrReport run_vr(const VrOptions& options) {
  const StopOnSignal signals;
  VrWorld world(options);
  auto connection = std::make_unique<VrConnection>(world);
  for (;;) {
    try {
      connection->show_frames();
      connection->finish();
      return world.report();
    } catch (const xr::LostError& lost) {
      connection.reset();
      world.record_event("session lost");
      if (options.reconnect_s > 0.0) {
        std::cerr << lost.what() << "; waiting " << options.reconnect_s << " s for a runtime\n";
      }
      connection = wait_for_runtime(world, Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                                              std::chrono::duration<double>(options.reconnect_s)));
      if (!connection) {
        throw;
      }
      world.runtime_returned();
    }
  }
}

}  // namespace app
