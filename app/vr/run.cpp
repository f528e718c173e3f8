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
std::unique_ptr<VrConnection> wait_for_runtime(VrWorld& world, const ControlSource& controls, MirrorLink* mirror,
                                               Clock::time_point until) {
  while (Clock::now() < until && !StopOnSignal::wanted()) {
    try {
      return std::make_unique<VrConnection>(world, controls, mirror);
    } catch (const xr::Error&) {
      std::this_thread::sleep_for(std::min<Clock::duration>(kBetweenTries, until - Clock::now()));
    }
  }
  return nullptr;
}

// To its end, with one runtime after the other; the mirror may be null.
void run_session(VrWorld& world, const ControlSource& controls, MirrorLink* mirror) {
  const auto reconnect = std::chrono::duration<double>(world.options().reconnect_s);
  auto connection = std::make_unique<VrConnection>(world, controls, mirror);
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
      connection = wait_for_runtime(world, controls, mirror,
                                    Clock::now() + std::chrono::duration_cast<Clock::duration>(reconnect));
      if (!connection) {
        throw;
      }
      world.runtime_returned();
    }
  }
}

}  // namespace

VrReport run_vr(const VrOptions& options, const ControlSource& more_controls) {
  const StopOnSignal signals;
  VrWorld world(options);
  if (options.mirror) {
    MirrorWindow().run_beside([&](MirrorLink& mirror) {
      const ControlSource controls = [&] {
        std::vector<xr::Control> pressed = mirror.pressed();
        if (more_controls) {
          const std::vector<xr::Control> more = more_controls();
          pressed.insert(pressed.end(), more.begin(), more.end());
        }
        return pressed;
      };
      run_session(world, controls, &mirror);
    });
  } else {
    run_session(world, more_controls, nullptr);
  }
  return world.report();
}

}  // namespace app
