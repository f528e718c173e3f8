#include "xr/actions.hpp"

#include <algorithm>
#include <iterator>

#include "xr/fixed_text.hpp"

namespace xr {
ActionSet::ActionSet(const Instance& instance, const std::string& name, const std::string& title) {
  XrActionSetCreateInfo info{};
  info.type = XR_TYPE_ACTION_SET_CREATE_INFO;
  copy_text(info.actionSetName, name);
  copy_text(info.localizedActionSetName, title);
  check(xrCreateActionSet(instance.handle(), &info, &set_), "xrCreateActionSet");
}

ActionSet::~ActionSet() {
  xrDestroyActionSet(set_);
}

XrAction ActionSet::add_action(XrActionType type, const std::string& name, const std::string& title) {
  XrActionCreateInfo info{};
  info.type = XR_TYPE_ACTION_CREATE_INFO;
  info.actionType = type;
  copy_text(info.actionName, name);
  copy_text(info.localizedActionName, title);
  XrAction action = XR_NULL_HANDLE;
  check(xrCreateAction(set_, &info, &action), "xrCreateAction");
  return action;
}

void ActionBindings::suggest(const std::string& profile, XrAction action, const std::string& path) {
  suggested_[profile].push_back({action, instance_.path(path.c_str())});
}

void ActionBindings::attach(const Session& session) {
  for (const auto& [profile, bindings] : suggested_) {
    XrInteractionProfileSuggestedBinding info{};
    info.type = XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING;
    info.interactionProfile = instance_.path(profile.c_str());
    info.countSuggestedBindings = static_cast<std::uint32_t>(bindings.size());
    info.suggestedBindings = bindings.data();
    const XrResult result = xrSuggestInteractionProfileBindings(instance_.handle(), &info);
    if (result != XR_ERROR_PATH_UNSUPPORTED) {
      check(result, "xrSuggestInteractionProfileBindings");
    }
  }
  if (sets_.empty()) {
    return;
  }
  XrSessionActionSetsAttachInfo info{};
  info.type = XR_TYPE_SESSION_ACTION_SETS_ATTACH_INFO;
  info.countActionSets = static_cast<std::uint32_t>(sets_.size());
  info.actionSets = sets_.data();
  check(xrAttachSessionActionSets(session.handle(), &info), "xrAttachSessionActionSets");
}

bool ActionBindings::sync(const Session& session) const {
  if (sets_.empty()) {
    return true;
  }
  std::vector<XrActiveActionSet> active;
  std::ranges::transform(sets_, std::back_inserter(active), [](XrActionSet set) {
    return XrActiveActionSet{set, XR_NULL_PATH};
  });
  XrActionsSyncInfo info{};
  info.type = XR_TYPE_ACTIONS_SYNC_INFO;
  info.countActiveActionSets = static_cast<std::uint32_t>(active.size());
  info.activeActionSets = active.data();
  return check(xrSyncActions(session.handle(), &info), "xrSyncActions") != XR_SESSION_NOT_FOCUSED;
}

}  // namespace xr
