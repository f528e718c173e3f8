// The wearer while head and eyes move: from poses and gaze to what the renderer takes, frame by frame. Lenses hang on
// the head, pupils are where the headset says, and what lies between the two is prism.
#pragma once

#include <array>
#include <optional>
#include <span>
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

// `now`, but with the views of `before` where they differ from it by no more than the runtime's rounding to float.
// Without it views would differ in every frame, and a recording keeps each change.
[[nodiscard]] HeadAndViews steadied(HeadAndViews now, const std::array<tracking::EyeView, 2>& before);

// Both eyes behind one pair as they are drawn, indexed by Side.
struct EyesDrawn {
  std::array<glm::dvec3, 2> gaze;  // before the lenses, head axes
  tracking::EyesInFrame eyes;
};

class LiveWearer {
 public:
  // all: for both eyes, with every pair that can be worn. Its sizes and viewing stay. Wears the first.
  LiveWearer(RenderSetup all, const render::Scene& scene);

  // Puts these of the pairs on, one or A and B. Eyes behind a pair that was not worn before go on as they were behind
  // the first that was.
  void wear(std::span<const std::size_t> pairs);

  // Moves eyes, lenses and fixation, accommodation and pupils in time. sample: see tracking::GazeFollower. target
  // (world): where the eyes turn if there is no sample; out of their reach it is lost.
  void step(double time, const HeadAndViews& where, const std::optional<tracking::GazeSample>& sample,
            const std::optional<glm::dvec3>& target = std::nullopt);

  // As a recording has them, pair by pair of those worn: the same numbers make the same picture.
  void place(const HeadAndViews& where, std::span<const EyesDrawn> eyes);

  // The scene was turned about the head.
  void turn_world(const glm::dquat& new_from_old);

  // With the pairs worn, as they are now.
  [[nodiscard]] const RenderSetup& setup() const { return setup_; }
  // With other pairs, for making a picture ahead: the headset's views as they are now, the eyes as at the start.
  [[nodiscard]] RenderSetup wearing(std::span<const std::size_t> pairs) const;
  // With every pair, as at the start.
  [[nodiscard]] const RenderSetup& all() const { return all_; }

  // Of the eyes behind the first pair worn, or another of them.
  [[nodiscard]] const tracking::EyeState& state(std::size_t worn = 0) const { return states_[worn].state(); }
  [[nodiscard]] tracking::GazeSource source() const;
  // The headset's, latest.
  [[nodiscard]] const std::array<tracking::EyeView, 2>& views() const { return views_; }

 private:
  [[nodiscard]] glm::dvec3 pupil_of(const HeadAndViews& where, tracking::Side side) const;
  void hang(WornPair& pair, const HeadAndViews& where);
  [[nodiscard]] tracking::GazeSample looking_at(const WornPair& pair, const tracking::Pose& world_from_head,
                                                const glm::dvec3& target) const;
  void set_views(std::size_t pair, const HeadAndViews& where, const EyesDrawn& drawn);

  RenderSetup all_, setup_;
  std::vector<std::size_t> worn_;            // of all_.pairs
  std::array<double, 2> settled_pupil_{};    // m, in the headset's light
  std::vector<tracking::LiveState> states_;  // one a pair worn
  bool at_target_ = false;
  std::array<tracking::EyeView, 2> views_;  // the latest
  render::RayQuery query_;
  render::SceneAlong scene_;
};

}  // namespace app
