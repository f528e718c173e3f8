#include "xr/spaces.hpp"

#include <algorithm>

#include "xr/convert.hpp"

namespace xr {

Space::Space(const Session& session, XrReferenceSpaceType type) : type_(type) {
  XrReferenceSpaceCreateInfo info{};
  info.type = XR_TYPE_REFERENCE_SPACE_CREATE_INFO;
  info.referenceSpaceType = type;
  info.poseInReferenceSpace = kIdentityPose;
  check(xrCreateReferenceSpace(session.handle(), &info, &space_), "xrCreateReferenceSpace");
}

Space::~Space() {
  xrDestroySpace(space_);
}

std::optional<tracking::Pose> Space::locate_in(const Space& base, XrTime time) const {
  constexpr XrSpaceLocationFlags kNeeded =
      XR_SPACE_LOCATION_ORIENTATION_VALID_BIT | XR_SPACE_LOCATION_POSITION_VALID_BIT;
  XrSpaceLocation location{};
  location.type = XR_TYPE_SPACE_LOCATION;
  check(xrLocateSpace(space_, base.space_, time, &location), "xrLocateSpace");
  if ((location.locationFlags & kNeeded) != kNeeded) {
    return std::nullopt;
  }
  return pose_of(location.pose);
}

XrReferenceSpaceType choose_space(const Session& session, SpaceChoice choice) {
  std::uint32_t count = 0;
  check(xrEnumerateReferenceSpaces(session.handle(), 0, &count, nullptr), "xrEnumerateReferenceSpaces");
  std::vector<XrReferenceSpaceType> offered(count);
  check(xrEnumerateReferenceSpaces(session.handle(), count, &count, offered.data()), "xrEnumerateReferenceSpaces");
  const auto is_offered = [&](XrReferenceSpaceType type) { return std::ranges::find(offered, type) != offered.end(); };
  struct Named {
    SpaceChoice choice;
    XrReferenceSpaceType type;
    const char* name;
  };
  for (const Named& named : {Named{SpaceChoice::local_floor, XR_REFERENCE_SPACE_TYPE_LOCAL_FLOOR_EXT, "LOCAL_FLOOR"},
                             Named{SpaceChoice::stage, XR_REFERENCE_SPACE_TYPE_STAGE, "STAGE"},
                             Named{SpaceChoice::local, XR_REFERENCE_SPACE_TYPE_LOCAL, "LOCAL"}}) {
    if (choice != SpaceChoice::automatic && choice != named.choice) {
      continue;
    }
    if (is_offered(named.type)) {
      return named.type;
    }
    if (choice == named.choice) {
      throw Error(std::string("openxr: the runtime does not offer the reference space ") + named.name);
    }
  }
  throw Error("openxr: the runtime offers no reference space, not even LOCAL");
}

bool is_on_floor(XrReferenceSpaceType type) {
  return type == XR_REFERENCE_SPACE_TYPE_STAGE || type == XR_REFERENCE_SPACE_TYPE_LOCAL_FLOOR_EXT;
}

void Recentring::handle(const XrEventDataBuffer& event) {
  if (event.type != XR_TYPE_EVENT_DATA_REFERENCE_SPACE_CHANGE_PENDING) {
    return;
  }
  const auto& change = reinterpret_cast<const XrEventDataReferenceSpaceChangePending&>(event);
  if (change.session == session_.handle() && change.referenceSpaceType == type_) {
    pending_.push_back({change.changeTime, change.poseValid != XR_FALSE ? pose_of(change.poseInPreviousSpace).inverse()
                                                                        : tracking::Pose{}});
  }
}

std::optional<tracking::Pose> Recentring::moved_by(XrTime time) {
  std::optional<tracking::Pose> moved;
  std::erase_if(pending_, [&](const Change& change) {
    if (change.time > time) {
      return false;
    }
    moved = change.new_from_old * moved.value_or(tracking::Pose{});
    return true;
  });
  return moved;
}

}  // namespace xr
