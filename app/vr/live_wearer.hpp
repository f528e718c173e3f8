// The wearer while head and eyes move: from poses and gaze to what the renderer takes, frame by frame. Lenses hang on
// the head, pupils are where the headset says, and what lies between the two is prism.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "app/render_setup.hpp"
#include "render/live_gaze.hpp"
#include "render/scene/ray_query.hpp"
#include "tracking/gaze_trace.hpp"
#include "tracking/live_state.hpp"

namespace app {

// Where head and views are at one moment.
struct HeadAndViews {
  tracking::Pose world_from_head;         // head axes as OpenXR's VIEW space
  std::array<tracking::EyeView, 2> eyes;  // by Side: each eye's view in the head; their gaze is not used
};

class LiveWearer {
 public:
  // setup: for both eyes. Its sizes and viewing stay.
  LiveWearer(RenderSetup setup, const render::Scene& scene);

  // Moves eyes, lenses and fixation, accommodation and pupils in time. sample: see tracking::GazeFollower.
  void step(double time, const HeadAndViews& where, const std::optional<tracking::GazeSample>& sample);

  // As a recording has them: the same numbers make the same picture. gaze: before the lenses. For one pair only.
  void place(const HeadAndViews& where, const std::array<glm::dvec3, 2>& gaze, const tracking::EyesInFrame& eyes);

  [[nodiscard]] const RenderSetup& setup() const { return setup_; }
  // Of the first pair.
  [[nodiscard]] const tracking::EyeState& state() const { return states_.front().state(); }

 private:
  [[nodiscard]] glm::dvec3 pupil_of(const HeadAndViews& where, tracking::Side side) const;
  void hang(WornPair& pair, const HeadAndViews& where);
  void set_views(std::size_t pair, const HeadAndViews& where, const std::array<glm::dvec3, 2>& gaze,
                 const tracking::EyesInFrame& eyes);

  RenderSetup setup_;
  std::vector<lenses::f64::LensData> fitted_;  // as the optician fitted them, each for a pupil in its place
  std::array<double, 2> settled_pupil_{};      // m, in the headset's light
  std::vector<tracking::LiveState> states_;    // one a pair
  render::RayQuery query_;
  render::SceneAlong scene_;
};

}  // namespace app
