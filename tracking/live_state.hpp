// The simulated wearer from frame to frame: one call a frame turns a tracker's sample and the head's pose into where
// both eyes look, how they accommodate and how wide their pupils are.
#pragma once

#include <array>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>

#include "tracking/accommodation.hpp"
#include "tracking/fixation_distance.hpp"
#include "tracking/gaze_follower.hpp"
#include "tracking/live_config.hpp"
#include "tracking/pupil_response.hpp"
#include "tracking/stereo_view.hpp"

namespace tracking {

// A question to whoever knows lenses and scene: what do eyes see that are turned so?
struct LookRequest {
  Pose world_from_head;
  bool two_lines = false;          // each eye's own line; else one for both, from `origin`
  glm::dvec3 origin{0.0};          // m, head axes
  std::array<glm::dvec3, 2> gaze;  // before the lenses, head axes, unit, indexed by Side; equal with one line
  std::optional<double> distance;  // m from the midpoint between the eyes; nothing: what the scene has there
};

struct LookedAt {
  std::array<glm::dvec3, 2> gaze;  // each eye's line, before its lens, head axes
  double distance = 0.0;           // m from the midpoint between the eyes; infinite for the sky
  std::array<double, 2> demand{};  // D, not limited; not finite where there is none
};

using Look = std::function<LookedAt(const LookRequest&)>;

// Indexed by Side.
struct EyeState {
  std::array<glm::dvec3, 2> gaze{glm::dvec3(0.0, 0.0, -1.0),
                                 glm::dvec3(0.0, 0.0, -1.0)};  // where the pupils are turned
  std::array<glm::dvec3, 2> target =
      gaze;                               // what is looked at, quicker and noisier: for what follows the gaze on screen
  double distance = 0.0;                  // m, fixated; infinite for the sky
  std::array<double, 2> demand{};         // D
  std::array<double, 2> accommodation{};  // D
  std::array<double, 2> pupil_diameter{};  // m
  GazeSource source = GazeSource::head;
  GazePhase phase = GazePhase::fixation;
  double age = 0.0;     // s since the tracker's last sample
  LookRequest request;  // what was asked last, to be asked again of another pair of spectacles
};

class LiveState {
 public:
  struct Wearer {
    std::array<double, 2> amplitude{};       // D
    std::array<double, 2> pupil_diameter{};  // m, at the start
  };

  LiveState(const LiveConfig& config, const Wearer& wearer);

  struct Frame {
    double time = 0.0;  // s; of the moment the frame is seen
    Pose world_from_head;
    std::optional<GazeSample> sample;       // see GazeFollower::step
    std::array<double, 2> settled_pupil{};  // m, that the light calls for
  };

  // `look` is asked twice a frame. A time that is not finite or lies before the last frame's gives the last state
  // again.
  const EyeState& step(const Frame& frame, const Look& look);

  // See GazeFollower::turn_world.
  void turn_world(const glm::dquat& new_from_old) { follower_.turn_world(new_from_old); }

  [[nodiscard]] const EyeState& state() const { return state_; }

 private:
  GazeFollower follower_;
  DepthHold depth_;
  Accommodation accommodation_;
  std::array<PupilResponse, 2> pupil_;
  std::optional<double> time_;
  EyeState state_;
};

}  // namespace tracking
