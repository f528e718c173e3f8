// Spaces that follow the gaze. The runtime has a space of each handle too, which never moves; the layer locates the
// head in its place and puts the gaze upon it.
#include "xr/convert.hpp"
#include "xr/layer/entry_points.hpp"
#include "xr/layer/gaze_poses.hpp"
#include "xr/layer/gaze_state.hpp"
#include "xr/layer/handles.hpp"
#include "xr/layer/structure_chain.hpp"

namespace xr::layer {
namespace {

using tracking::Pose;

struct Located {
  XrSpaceLocationFlags flags = 0;
  Pose pose;
  XrTime sample_time = 0;
};

// Null unless the layer answers for the space.
std::shared_ptr<ActionSpace> gaze_space(XrSpace handle) {
  auto space = handles().spaces.find(handle);
  return space && space->session->gives_gaze && space->action->gaze ? space : nullptr;
}

// A program has one instance at a time (loaders allow no more), so it is the one of spaces that are none of ours.
std::shared_ptr<Instance> only_instance() {
  const auto all = handles().instances.all();
  if (all.size() != 1) {
    throw CallFailed{XR_ERROR_HANDLE_INVALID};
  }
  return all.front();
}

Located locate_below(const NextFunctions& next, XrSpace space, XrSpace base, XrTime time) {
  XrSpaceLocation location{};
  location.type = XR_TYPE_SPACE_LOCATION;
  check(next.xrLocateSpace(space, base, time, &location));
  Located located{.flags = location.locationFlags, .pose = {}, .sample_time = 0};
  if (gaze_flags(located.flags) != 0) {
    located.pose = pose_of(location.pose);
  }
  return located;
}

Located gaze_in_view(const ActionSpace& space, XrTime time) {
  const GazeReading reading = gaze_at(*space.session, time);
  if (!reading.valid || !gaze_is_active(*space.session, *space.action)) {
    return {};
  }
  constexpr XrSpaceLocationFlags kAll = XR_SPACE_LOCATION_POSITION_VALID_BIT | XR_SPACE_LOCATION_ORIENTATION_VALID_BIT |
                                        XR_SPACE_LOCATION_POSITION_TRACKED_BIT |
                                        XR_SPACE_LOCATION_ORIENTATION_TRACKED_BIT;
  return {.flags = kAll,
          .pose = gaze_pose(combined_direction(reading.direction), glm::dvec3(0.0)) * space.gaze_from_space,
          .sample_time = reading.sample_time};
}

// Either or both of the spaces follow the gaze.
Located locate_gaze(const std::shared_ptr<ActionSpace>& gaze, XrSpace space,
                    const std::shared_ptr<ActionSpace>& base_gaze, XrSpace base, XrTime time) {
  Session& session = gaze ? *gaze->session : *base_gaze->session;
  const NextFunctions& next = session.instance->next;
  const XrSpace view = view_space(session);
  // Asked even where there is no gaze: what is wrong with time, space or session is the runtime's to say.
  const Located rest = locate_below(next, gaze ? view : space, base_gaze ? view : base, time);
  const Located of_space = gaze ? gaze_in_view(*gaze, time) : rest;
  const Located of_base = base_gaze ? gaze_in_view(*base_gaze, time) : rest;
  const XrSpaceLocationFlags flags = gaze_flags(rest.flags) & of_space.flags & of_base.flags;
  if (flags == 0) {
    return {};
  }
  Located located{.flags = flags, .pose = {}, .sample_time = of_space.sample_time};
  if (gaze && base_gaze) {
    located.pose = of_base.pose.inverse() * of_space.pose;
  } else {
    located.pose = gaze ? rest.pose * of_space.pose : of_base.pose.inverse() * rest.pose;
  }
  return located;
}

void answer(const Located& located, XrSpaceLocation& location) {
  location.locationFlags = located.flags;
  location.pose = to_xr(located.pose);
  if (auto* velocity = find_structure<XrSpaceVelocity>(location.next, XR_TYPE_SPACE_VELOCITY)) {
    velocity->velocityFlags = 0;  // an eye tracker's samples have none
  }
  if (auto* sample = find_structure<XrEyeGazeSampleTimeEXT>(location.next, XR_TYPE_EYE_GAZE_SAMPLE_TIME_EXT)) {
    sample->time = located.sample_time;
  }
}

XrResult locate(XrSpace space, XrSpace base, XrTime time, XrSpaceLocation* location) {
  const auto gaze = gaze_space(space);
  const auto base_gaze = gaze_space(base);
  if (!gaze && !base_gaze) {
    return only_instance()->next.xrLocateSpace(space, base, time, location);
  }
  if (!location || location->type != XR_TYPE_SPACE_LOCATION) {
    return XR_ERROR_VALIDATION_FAILURE;
  }
  if (gaze && !gaze->eyes_only && gaze->action->elsewhere) {
    // A hand that is tracked goes before the eyes where the program left the choice.
    const XrResult result = check(gaze->session->instance->next.xrLocateSpace(space, base, time, location));
    if ((location->locationFlags & XR_SPACE_LOCATION_ORIENTATION_TRACKED_BIT) != 0) {
      return result;
    }
  }
  answer(locate_gaze(gaze, space, base_gaze, base, time), *location);
  return XR_SUCCESS;
}

}  // namespace

XRAPI_ATTR XrResult XRAPI_CALL create_action_space(XrSession handle, const XrActionSpaceCreateInfo* info,
                                                   XrSpace* out) noexcept {
  return guarded([&] {
    const auto session = handles().sessions.get(handle);
    const Instance& instance = *session->instance;
    const auto action = info ? handles().actions.find(info->action) : nullptr;
    const bool of_eyes = info && instance.gaze_interaction.program && info->subactionPath == instance.paths.eyes;
    XrActionSpaceCreateInfo below = info ? *info : XrActionSpaceCreateInfo{};
    if (of_eyes && !instance.gaze_interaction.runtime) {
      if (action && !action->of_eyes) {
        return XR_ERROR_PATH_UNSUPPORTED;
      }
      below.subactionPath = XR_NULL_PATH;
    }
    const XrResult result = check(instance.next.xrCreateActionSpace(handle, info ? &below : nullptr, out));
    if (action && action->type == XR_ACTION_TYPE_POSE_INPUT && (of_eyes || info->subactionPath == XR_NULL_PATH)) {
      auto space = std::make_shared<ActionSpace>();
      space->session = session;
      space->action = action;
      space->eyes_only = of_eyes;
      space->gaze_from_space = pose_of(info->poseInActionSpace);
      handles().spaces.add(*out, std::move(space));
    }
    return result;
  });
}

XRAPI_ATTR XrResult XRAPI_CALL destroy_space(XrSpace handle) noexcept {
  return guarded([&] {
    const auto space = handles().spaces.find(handle);
    const auto instance = space ? space->session->instance : only_instance();
    handles().spaces.erase(handle);
    return instance->next.xrDestroySpace(handle);
  });
}

XRAPI_ATTR XrResult XRAPI_CALL locate_space(XrSpace space, XrSpace base, XrTime time,
                                            XrSpaceLocation* location) noexcept {
  return guarded([&] { return locate(space, base, time, location); });
}

XRAPI_ATTR XrResult XRAPI_CALL locate_spaces(XrSession handle, const XrSpacesLocateInfoKHR* info,
                                             XrSpaceLocationsKHR* locations) noexcept {
  return guarded([&] {
    const auto session = handles().sessions.get(handle);
    const bool any_gaze =
        info && (gaze_space(info->baseSpace) || std::any_of(info->spaces, info->spaces + info->spaceCount,
                                                            [](XrSpace s) { return gaze_space(s) != nullptr; }));
    if (!any_gaze) {
      return session->instance->next.xrLocateSpacesKHR(handle, info, locations);
    }
    if (!locations || locations->locationCount != info->spaceCount || !locations->locations) {
      return XR_ERROR_VALIDATION_FAILURE;
    }
    auto* velocities = find_structure<XrSpaceVelocitiesKHR>(locations->next, XR_TYPE_SPACE_VELOCITIES_KHR);
    for (std::uint32_t i = 0; i < info->spaceCount; ++i) {
      XrSpaceVelocity velocity{};
      velocity.type = XR_TYPE_SPACE_VELOCITY;
      XrSpaceLocation location{};
      location.type = XR_TYPE_SPACE_LOCATION;
      location.next = velocities ? &velocity : nullptr;
      check(locate(info->spaces[i], info->baseSpace, info->time, &location));
      locations->locations[i] = {location.locationFlags, location.pose};
      if (velocities && i < velocities->velocityCount) {
        velocities->velocities[i] = {velocity.velocityFlags, velocity.linearVelocity, velocity.angularVelocity};
      }
    }
    return XR_SUCCESS;
  });
}

}  // namespace xr::layer
