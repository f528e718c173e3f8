#include "app/vr/run.hpp"

#include "app/vr/connection.hpp"
#include "app/vr/stop_signal.hpp"
#include "app/vr/world.hpp"

namespace app {

VrReport run_vr(const VrOptions& options) {
  const StopOnSignal signals;
  VrWorld world(options);
  try {
    VrConnection connection(world);
    connection.show_frames();
    connection.finish();
  } catch (const xr::LostError&) {
    world.record_event("session lost");
    throw;
  }
  return world.report();
}

}  // namespace app
