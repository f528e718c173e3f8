#include "xr/layer/handles.hpp"

namespace xr::layer {

void Handles::forget_session(const Session& session) {
  eye_trackers.erase_if([&](const EyeTracker& tracker) { return tracker.session.get() == &session; });
  spaces.erase_if([&](const ActionSpace& space) { return space.session.get() == &session; });
  sessions.erase(session.handle);
}

void Handles::forget_instance(const Instance& instance) {
  for (const auto& session : sessions.all()) {
    if (session->instance.get() == &instance) {
      forget_session(*session);
    }
  }
  actions.erase_if([&](const Action& action) { return action.set->instance.get() == &instance; });
  action_sets.erase_if([&](const ActionSet& set) { return set.instance.get() == &instance; });
  instances.erase(instance.handle);
}

Handles& handles() {
  static Handles tables;
  return tables;
}

}  // namespace xr::layer
