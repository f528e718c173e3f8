#include "app/vr/run.hpp"

#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>
#include <thread>

#include "app/vr/connection.hpp"
#include "app/vr/mirror_window.hpp"
#include "app/vr/stop_signal.hpp"
#include "app/vr/world.hpp"

namespace app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kBetweenTries{500};

// A runtime that is started again takes its time; how it fails meanwhile says nothing. Null where none came in time, or
// the user has had enough.
std::unique_ptr<VrConnection> wait_for_runtime(VrWorld& world, MirrorLink* mirror, Clock::time_point until) {
  while (Clock::now() < until && !StopOnSignal::wanted()) {
    try {
      return std::make_unique<VrConnection>(world, mirror);
    } catch (const xr::Error&) {
      std::this_thread::sleep_for(std::min<Clock::duration>(kBetweenTries, until - Clock::now()));
    }
  }
  return nullptr;
}

// To its end, with one runtime after the other; the mirror may be null.
void run_session(VrWorld& world, MirrorLink* mirror) {
  const auto reconnect = std::chrono::duration<double>(world.options().reconnect_s);
  auto connection = std::make_unique<VrConnection>(world, mirror);
  for (;;) {
    try {
      connection->show_frames();
      connection->finish();
      return;
    } catch (const xr::LostError& lost) {
      connection.reset();
      world.record_event("session lost");
      if (reconnect.count() > 0.0) {
        std::cerr << lost.what() << "; waiting " << reconnect.count() << " s for a runtime\n";
      }
      connection =
          wait_for_runtime(world, mirror, Clock::now() + std::chrono::duration_cast<Clock::duration>(reconnect));
      if (!connection) {
        throw;
      }
      world.runtime_returned();
    }
  }
}

}  // namespace

VrReport run_vr(const VrOptions& options) {
  const StopOnSignal signals;
  VrWorld world(options);
  if (options.mirror) {
    MirrorWindow().run_beside([&](MirrorLink& mirror) { run_session(world, &mirror); });
  } else {
    run_session(world, nullptr);
  }
  return world.report();
}

}  // namespace app
