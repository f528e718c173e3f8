#include "app/vr/run.hpp"

#include "app/vr/connection.hpp"
#include "app/vr/mirror_window.hpp"
#include "app/vr/stop_signal.hpp"
#include "app/vr/world.hpp"

namespace app {

namespace {

void run_session(VrWorld& world, MirrorLink* mirror) {
  try {
    VrConnection connection(world, mirror);
    connection.show_frames();
    connection.finish();
  } catch (const xr::LostError&) {
    world.record_event("session lost");
    throw;
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
