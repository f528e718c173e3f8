// What the layer knows of each OpenXR handle that passes through it. OpenXR's calls name nothing but handles, so these
// tables are the process's; each table has a lock of its own, and no lock is held during a call to the runtime.
#pragma once

#include <algorithm>
#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <unordered_map>
#include <vector>

#include "tracking/stereo_view.hpp"
#include "xr/layer/gaze_source.hpp"
#include "xr/layer/guard.hpp"
#include "xr/layer/next_functions.hpp"

namespace xr::layer {

// Who has an extension: the program asked for it, and the runtime knows it.
struct ExtensionUse {
  bool program = false, runtime = false;
};

struct GazePaths {
  XrPath profile = XR_NULL_PATH;  // /interaction_profiles/ext/eye_gaze_interaction
  XrPath eyes = XR_NULL_PATH;     // /user/eyes_ext
  XrPath input = XR_NULL_PATH;    // /user/eyes_ext/input/gaze_ext
  XrPath pose = XR_NULL_PATH;     // /user/eyes_ext/input/gaze_ext/pose
};

struct Instance {
  XrInstance handle = XR_NULL_HANDLE;
  NextFunctions next;
  ExtensionUse gaze_interaction, eye_tracking;
  bool force = false;                  // even where the runtime has gaze of its own
  std::shared_ptr<GazeSource> source;  // null: nothing to give
  GazePaths paths;

  [[nodiscard]] bool idle() const { return !gaze_interaction.program && !eye_tracking.program; }
};

struct ActionSet {
  std::shared_ptr<Instance> instance;
  XrActionSet handle = XR_NULL_HANDLE;
  std::atomic<bool> attached = false;
};

struct Action {
  std::shared_ptr<ActionSet> set;
  XrActionType type = XR_ACTION_TYPE_POSE_INPUT;
  bool of_eyes = false;                 // /user/eyes_ext is among its subaction paths
  std::atomic<bool> gaze = false;       // bound to the gaze
  std::atomic<bool> elsewhere = false;  // bound to something else too
};

struct ActiveSet {
  XrActionSet set;
  XrPath subaction;
};

struct Session {
  std::shared_ptr<Instance> instance;
  XrSession handle = XR_NULL_HANDLE;
  bool gives_gaze = false, gives_eyes = false;  // the layer, not the runtime, answers for the one and the other

  std::mutex mutex;  // of all below
  XrSessionState state = XR_SESSION_STATE_IDLE;
  std::vector<ActiveSet> active;  // of the last xrSyncActions
  bool attached = false, synchronized = false, profile_event = false;
  std::optional<XrTime> start;
  XrSpace view = XR_NULL_HANDLE;
};

struct ActionSpace {
  std::shared_ptr<Session> session;
  std::shared_ptr<Action> action;
  bool eyes_only = false;  // made for the subaction path of the eyes
  tracking::Pose gaze_from_space;
};

struct EyeTracker {
  std::shared_ptr<Session> session;
};

template <class Handle, class Object>
class HandleTable {
 public:
  void add(Handle handle, std::shared_ptr<Object> object) {
    const std::lock_guard lock(mutex_);
    objects_[handle] = std::move(object);
  }

  // Null where the handle is none of ours.
  [[nodiscard]] std::shared_ptr<Object> find(Handle handle) const {
    const std::lock_guard lock(mutex_);
    const auto at = objects_.find(handle);
    return at == objects_.end() ? nullptr : at->second;
  }

  [[nodiscard]] std::shared_ptr<Object> get(Handle handle) const {
    auto object = find(handle);
    if (!object) {
      throw CallFailed{XR_ERROR_HANDLE_INVALID};
    }
    return object;
  }

  bool erase(Handle handle) {
    const std::lock_guard lock(mutex_);
    return objects_.erase(handle) != 0;
  }

  template <class Predicate>
  void erase_if(const Predicate& predicate) {
    const std::lock_guard lock(mutex_);
    std::erase_if(objects_, [&](const auto& entry) { return predicate(*entry.second); });
  }

  [[nodiscard]] std::vector<std::shared_ptr<Object>> all() const {
    const std::lock_guard lock(mutex_);
    std::vector<std::shared_ptr<Object>> list;
    for (const auto& entry : objects_) {
      list.push_back(entry.second);
    }
    return list;
  }

  [[nodiscard]] std::size_t size() const {
    const std::lock_guard lock(mutex_);
    return objects_.size();
  }

 private:
  mutable std::mutex mutex_;
  std::unordered_map<Handle, std::shared_ptr<Object>> objects_;
};

struct Handles {
  HandleTable<XrInstance, Instance> instances;
  HandleTable<XrSession, Session> sessions;
  HandleTable<XrActionSet, ActionSet> action_sets;
  HandleTable<XrAction, Action> actions;
  HandleTable<XrSpace, ActionSpace> spaces;
  HandleTable<XrEyeTrackerFB, EyeTracker> eye_trackers;

  void forget_session(const Session& session);
  void forget_instance(const Instance& instance);
};

[[nodiscard]] Handles& handles();

}  // namespace xr::layer
