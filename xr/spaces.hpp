// The space that the scene stands in, the head's own, and recentring.
#pragma once

#include <optional>
#include <vector>

#include "tracking/stereo_view.hpp"
#include "xr/session.hpp"

namespace xr {

// A reference space of the session's.
class Space {
 public:
  Space(const Session& session, XrReferenceSpaceType type);
  ~Space();
  Space(const Space&) = delete;
  Space& operator=(const Space&) = delete;

  [[nodiscard]] XrSpace handle() const { return space_; }
  [[nodiscard]] XrReferenceSpaceType type() const { return type_; }

  // This space's pose in another; absent while it is not known.
  [[nodiscard]] std::optional<tracking::Pose> locate_in(const Space& base, XrTime time) const;

 private:
  XrReferenceSpaceType type_;
  XrSpace space_ = XR_NULL_HANDLE;
};

enum class SpaceChoice { automatic, local_floor, stage, local };

// automatic: LOCAL_FLOOR, else STAGE, else LOCAL, whichever the runtime offers first. One that is asked for and not
// offered throws Error. LOCAL_FLOOR wants the extension XR_EXT_local_floor to be enabled.
[[nodiscard]] XrReferenceSpaceType choose_space(const Session& session, SpaceChoice choice);

// Whether its origin is on the floor; LOCAL's is where the head was.
[[nodiscard]] bool is_on_floor(XrReferenceSpaceType type);

// The user (or the runtime) moves a space's origin: announced before, true from a given time on. Located poses change
// by themselves; whoever remembers poses of the space from frame to frame must carry them over.
class Recentring {
 public:
  Recentring(const Session& session, XrReferenceSpaceType type) : session_(session), type_(type) {}

  void handle(const XrEventDataBuffer& event);

  // If the origin has moved between the last call's time and this: new_from_old, to be applied to remembered poses. A
  // change whose size the runtime does not know gives the identity.
  [[nodiscard]] std::optional<tracking::Pose> moved_by(XrTime time);

 private:
  struct Change {
    XrTime time;
    tracking::Pose new_from_old;
  };
  const Session& session_;
  XrReferenceSpaceType type_;
  std::vector<Change> pending_;
};

}  // namespace xr
