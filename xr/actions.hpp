// Input actions. A session takes its action sets once, and each interaction profile its bindings in one piece, so gaze,
// controllers and whatever else wants input first say here what they need; then all of it is attached.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "xr/session.hpp"

namespace xr {

class ActionSet {
 public:
  // name: lower case, as OpenXR's paths; title is what a runtime's binding dialogue shows.
  ActionSet(const Instance& instance, const std::string& name, const std::string& title);
  ~ActionSet();
  ActionSet(const ActionSet&) = delete;
  ActionSet& operator=(const ActionSet&) = delete;

  [[nodiscard]] XrActionSet handle() const { return set_; }
  // Lives as long as the set.
  [[nodiscard]] XrAction add_action(XrActionType type, const std::string& name, const std::string& title);

 private:
  XrActionSet set_ = XR_NULL_HANDLE;
};

class ActionBindings {
 public:
  // Refers to the instance; sets must outlive the session they are attached to.
  explicit ActionBindings(const Instance& instance) : instance_(instance) {}

  void add_set(const ActionSet& set) { sets_.push_back(set.handle()); }
  // profile: "/interaction_profiles/khr/simple_controller"; path: "/user/hand/right/input/select/click".
  void suggest(const std::string& profile, XrAction action, const std::string& path);

  // Hands everything to the runtime; nothing can be added afterwards. A profile that the runtime does not know is left
  // out.
  void attach(const Session& session);

  // Reads all attached sets; false while the session has no focus, when no action is active. Nothing to do where
  // nothing was attached.
  bool sync(const Session& session) const;

 private:
  const Instance& instance_;
  std::vector<XrActionSet> sets_;
  std::map<std::string, std::vector<XrActionSuggestedBinding>> suggested_;
};

}  // namespace xr
