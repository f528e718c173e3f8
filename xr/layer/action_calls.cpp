#include "xr/layer/entry_points.hpp"
#include "xr/layer/gaze_state.hpp"
#include "xr/layer/handles.hpp"

namespace xr::layer {
namespace {

std::shared_ptr<Action> action_of(XrAction handle) {
  return handles().actions.get(handle);
}

// What a runtime without the extension must refuse, said in its place.
void check_gaze_suggestion(const Instance& instance, const XrInteractionProfileSuggestedBinding& suggested) {
  if (suggested.countSuggestedBindings == 0 || !suggested.suggestedBindings) {
    throw CallFailed{XR_ERROR_VALIDATION_FAILURE};
  }
  for (std::uint32_t i = 0; i < suggested.countSuggestedBindings; ++i) {
    const XrActionSuggestedBinding& binding = suggested.suggestedBindings[i];
    if (binding.binding != instance.paths.pose && binding.binding != instance.paths.input) {
      throw CallFailed{XR_ERROR_PATH_UNSUPPORTED};
    }
    if (action_of(binding.action)->set->attached) {
      throw CallFailed{XR_ERROR_ACTIONSETS_ALREADY_ATTACHED};
    }
  }
}

// A suggestion takes the place of an earlier one for the same profile.
void note_gaze_suggestion(const Instance& instance, const XrInteractionProfileSuggestedBinding& suggested) {
  for (const auto& action : handles().actions.all()) {
    if (action->set->instance.get() == &instance && !action->set->attached) {
      action->gaze = false;
    }
  }
  for (std::uint32_t i = 0; i < suggested.countSuggestedBindings; ++i) {
    if (const auto action = handles().actions.find(suggested.suggestedBindings[i].action)) {
      action->gaze = action->type == XR_ACTION_TYPE_POSE_INPUT;
    }
  }
}

}  // namespace

XRAPI_ATTR XrResult XRAPI_CALL create_action_set(XrInstance handle, const XrActionSetCreateInfo* info,
                                                 XrActionSet* out) noexcept {
  return guarded([&] {
    const auto instance = handles().instances.get(handle);
    const XrResult result = check(instance->next.xrCreateActionSet(handle, info, out));
    auto set = std::make_shared<ActionSet>();
    set->instance = instance;
    set->handle = *out;
    handles().action_sets.add(*out, std::move(set));
    return result;
  });
}

// What hangs on an action lives on while a space or a session uses it; only its handle is gone.
XRAPI_ATTR XrResult XRAPI_CALL destroy_action_set(XrActionSet handle) noexcept {
  return guarded([&] {
    const auto set = handles().action_sets.get(handle);
    const XrResult result = check(set->instance->next.xrDestroyActionSet(handle));
    handles().actions.erase_if([&](const Action& action) { return action.set == set; });
    handles().action_sets.erase(handle);
    return result;
  });
}

XRAPI_ATTR XrResult XRAPI_CALL create_action(XrActionSet set_handle, const XrActionCreateInfo* info,
                                             XrAction* out) noexcept {
  return guarded([&] {
    const auto set = handles().action_sets.get(set_handle);
    const Instance& instance = *set->instance;
    auto action = std::make_shared<Action>();
    action->set = set;
    std::vector<XrPath> others;
    for (std::uint32_t i = 0; i < (info ? info->countSubactionPaths : 0); ++i) {
      if (info->subactionPaths[i] == instance.paths.eyes) {
        action->of_eyes = true;
      } else {
        others.push_back(info->subactionPaths[i]);
      }
    }
    XrResult result;
    if (action->of_eyes && !instance.gaze_interaction.runtime) {
      XrActionCreateInfo below = *info;
      below.countSubactionPaths = static_cast<std::uint32_t>(others.size());
      below.subactionPaths = others.empty() ? nullptr : others.data();
      result = check(instance.next.xrCreateAction(set_handle, &below, out));
    } else {
      result = check(instance.next.xrCreateAction(set_handle, info, out));
    }
    action->type = info->actionType;
    handles().actions.add(*out, std::move(action));
    return result;
  });
}

XRAPI_ATTR XrResult XRAPI_CALL destroy_action(XrAction handle) noexcept {
  return guarded([&] {
    const auto action = action_of(handle);
    const XrResult result = check(action->set->instance->next.xrDestroyAction(handle));
    handles().actions.erase(handle);
    return result;
  });
}

XRAPI_ATTR XrResult XRAPI_CALL suggest_interaction_profile_bindings(
    XrInstance handle, const XrInteractionProfileSuggestedBinding* suggested) noexcept {
  return guarded([&] {
    const auto instance = handles().instances.get(handle);
    const bool of_gaze =
        suggested && instance->gaze_interaction.program && suggested->interactionProfile == instance->paths.profile;
    XrResult result = XR_SUCCESS;
    if (of_gaze && !instance->gaze_interaction.runtime) {
      check_gaze_suggestion(*instance, *suggested);
    } else {
      result = check(instance->next.xrSuggestInteractionProfileBindings(handle, suggested));
    }
    if (of_gaze) {
      note_gaze_suggestion(*instance, *suggested);
    } else {
      for (std::uint32_t i = 0; i < suggested->countSuggestedBindings; ++i) {
        if (const auto action = handles().actions.find(suggested->suggestedBindings[i].action)) {
          action->elsewhere = true;
        }
      }
    }
    return result;
  });
}

XRAPI_ATTR XrResult XRAPI_CALL get_action_state_pose(XrSession handle, const XrActionStateGetInfo* info,
                                                     XrActionStatePose* state) noexcept {
  return guarded([&] {
    const auto session = handles().sessions.get(handle);
    const Instance& instance = *session->instance;
    const auto action = info ? handles().actions.find(info->action) : nullptr;
    const bool of_eyes = info && info->subactionPath == instance.paths.eyes && instance.gaze_interaction.program;
    XrActionStateGetInfo below = info ? *info : XrActionStateGetInfo{};
    if (of_eyes && !instance.gaze_interaction.runtime) {
      if (action && !action->of_eyes) {
        return XR_ERROR_PATH_UNSUPPORTED;
      }
      below.subactionPath = XR_NULL_PATH;
    }
    const XrResult result = check(instance.next.xrGetActionStatePose(handle, info ? &below : nullptr, state));
    if (of_eyes && !instance.gaze_interaction.runtime) {
      state->isActive = XR_FALSE;  // the runtime spoke for hands
    }
    if (!state->isActive && action && action->gaze && session->gives_gaze &&
        (of_eyes || info->subactionPath == XR_NULL_PATH) && gaze_is_active(*session, *action)) {
      state->isActive = tracker_present(*session);
    }
    return result;
  });
}

}  // namespace xr::layer
