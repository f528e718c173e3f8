// What a program may ask about where an action's input comes from.
#include <cstring>
#include <string_view>

#include "xr/layer/entry_points.hpp"
#include "xr/layer/gaze_state.hpp"
#include "xr/layer/handles.hpp"

namespace xr::layer {
namespace {

// OpenXR's two calls: capacity 0 asks for the count.
template <class Element>
XrResult give(const std::vector<Element>& all, std::uint32_t capacity, std::uint32_t* count, Element* out) {
  if (!count) {
    return XR_ERROR_VALIDATION_FAILURE;
  }
  *count = static_cast<std::uint32_t>(all.size());
  if (capacity == 0) {
    return XR_SUCCESS;
  }
  if (capacity < all.size()) {
    return XR_ERROR_SIZE_INSUFFICIENT;
  }
  if (!out) {
    return XR_ERROR_VALIDATION_FAILURE;
  }
  std::copy(all.begin(), all.end(), out);
  return XR_SUCCESS;
}

}  // namespace

XRAPI_ATTR XrResult XRAPI_CALL get_current_interaction_profile(XrSession handle, XrPath top_level,
                                                               XrInteractionProfileState* state) noexcept {
  return guarded([&] {
    const auto session = handles().sessions.get(handle);
    const Instance& instance = *session->instance;
    const bool ours = top_level == instance.paths.eyes && instance.gaze_interaction.program &&
                      (session->gives_gaze || !instance.gaze_interaction.runtime);
    if (!ours) {
      return instance.next.xrGetCurrentInteractionProfile(handle, top_level, state);
    }
    if (!state || state->type != XR_TYPE_INTERACTION_PROFILE_STATE) {
      return XR_ERROR_VALIDATION_FAILURE;
    }
    const bool bound = has_gaze_bindings(*session);
    const std::lock_guard lock(session->mutex);
    if (!session->attached) {
      return XR_ERROR_ACTIONSET_NOT_ATTACHED;
    }
    state->interactionProfile = bound && session->synchronized ? instance.paths.profile : XR_NULL_PATH;
    return XR_SUCCESS;
  });
}

XRAPI_ATTR XrResult XRAPI_CALL enumerate_bound_sources(XrSession handle,
                                                       const XrBoundSourcesForActionEnumerateInfo* info,
                                                       uint32_t capacity, uint32_t* count, XrPath* sources) noexcept {
  return guarded([&] {
    const auto session = handles().sessions.get(handle);
    const Instance& instance = *session->instance;
    const auto action = info ? handles().actions.find(info->action) : nullptr;
    if (!action || !action->gaze || !session->gives_gaze) {
      return instance.next.xrEnumerateBoundSourcesForAction(handle, info, capacity, count, sources);
    }
    std::uint32_t below = 0;
    check(instance.next.xrEnumerateBoundSourcesForAction(handle, info, 0, &below, nullptr));
    std::vector<XrPath> all(below);
    if (below > 0) {
      check(instance.next.xrEnumerateBoundSourcesForAction(handle, info, below, &below, all.data()));
      all.resize(below);
    }
    if (std::find(all.begin(), all.end(), instance.paths.pose) == all.end()) {
      all.push_back(instance.paths.pose);
    }
    return give(all, capacity, count, sources);
  });
}

XRAPI_ATTR XrResult XRAPI_CALL get_input_source_localized_name(XrSession handle,
                                                               const XrInputSourceLocalizedNameGetInfo* info,
                                                               uint32_t capacity, uint32_t* count,
                                                               char* buffer) noexcept {
  return guarded([&] {
    const auto session = handles().sessions.get(handle);
    const Instance& instance = *session->instance;
    if (!session->gives_gaze || !info || info->sourcePath != instance.paths.pose) {
      return instance.next.xrGetInputSourceLocalizedName(handle, info, capacity, count, buffer);
    }
    constexpr std::string_view kName = "Eye gaze";
    std::vector<char> text(kName.begin(), kName.end());
    text.push_back('\0');
    return give(text, capacity, count, buffer);
  });
}

}  // namespace xr::layer
