// The wearer while head and eyes move: from poses to what the renderer takes, frame by frame. Lenses hang on the head,
// pupils are where the headset says, and what lies between the two is prism.
#pragma once

#include <array>
#include <vector>

#include "app/render_setup.hpp"
#include "render/scene/ray_query.hpp"

namespace app {

// Head and eyes at one moment.
struct Sighting {
  tracking::Pose world_from_head;         // head axes as OpenXR's VIEW space
  std::array<tracking::EyeView, 2> eyes;  // by Side: each eye's view in the head; their gaze is not used
  glm::dvec3 gaze{0.0, 0.0, -1.0};        // of both eyes together, before the lenses, head axes
};

class LiveWearer {
 public:
  // setup: for both eyes. Its sizes and viewing stay.
  LiveWearer(RenderSetup setup, const render::Scene& scene);

  // Moves eyes, lenses and fixation.
  void place(const Sighting& sighting);

  [[nodiscard]] const RenderSetup& setup() const { return setup_; }

 private:
  // Where an eye's pupil is in the head.
  [[nodiscard]] glm::dvec3 pupil_of(const Sighting& sighting, tracking::Side side) const;
  void place_pair(WornPair& pair, const Sighting& sighting);

  RenderSetup setup_;
  std::vector<lenses::f64::LensData> fitted_;  // as the optician fitted them, each for a pupil in its place
  render::RayQuery query_;
};

}  // namespace app
