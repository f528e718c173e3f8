#include "app/vr/live_wearer.hpp"

#include <utility>

namespace app {
namespace {

using tracking::Pose;
using tracking::Side;

constexpr std::array kSides{Side::right, Side::left};

constexpr std::size_t index_of(Side side) {
  return static_cast<std::size_t>(side);
}

tracking::LiveState start_state(const RenderSetup& setup, const WornPair& pair) {
  tracking::LiveState::Wearer wearer;
  for (const std::size_t i : {0U, 1U}) {
    wearer.amplitude[i] = pair.eyes[i].eye.excess.w;
    wearer.pupil_diameter[i] = pair.eyes[i].eye.pupil.x;
  }
  return {setup.wearer.live, wearer};
}

}  // namespace

LiveWearer::LiveWearer(RenderSetup setup, const render::Scene& scene)
    : setup_(std::move(setup)), fitted_(setup_.lenses.lens), query_(scene), scene_(render::scene_along(query_)) {
  for (const WornPair& pair : setup_.pairs) {
    states_.push_back(start_state(setup_, pair));
  }
  for (const std::size_t i : {0U, 1U}) {
    settled_pupil_[i] = setup_.pairs.front().eyes[i].eye.pupil.x;
  }
}

glm::dvec3 LiveWearer::pupil_of(const HeadAndViews& where, Side side) const {
  const glm::dvec3 origin = where.eyes[index_of(side)].head_from_view.position;
  const bool behind =
      setup_.headset && setup_.headset->view_origin == lenses::HeadsetDisplay::ViewOrigin::rotation_centre;
  return behind ? origin - glm::dvec3(0.0, 0.0, setup_.pairs.front().eyes[index_of(side)].eye.pupil.y) : origin;
}

void LiveWearer::hang(WornPair& pair, const HeadAndViews& where) {
  const glm::dvec3 nose = 0.5 * (pupil_of(where, Side::right) + pupil_of(where, Side::left));
  for (const Side side : kSides) {
    const std::size_t i = index_of(side);
    const glm::dvec3 pupil = pupil_of(where, side);
    lenses::f64::LensData& lens = setup_.lenses.lens[pair.lens[i]];
    lens = fitted_[pair.lens[i]];
    if (lens.mount.x == 0) {  // on the head: a contact lens goes with its eye
      const double half = (side == Side::right ? 1.0 : -1.0) * setup_.wearer.pupillary_distance[i];
      const glm::dvec3 shift = nose + glm::dvec3(half, 0.0, 0.0) - pupil;
      lens.axis_x.w += shift.x;
      lens.axis_y.w += shift.y;
      lens.axis_z.w += shift.z;
    }
    pair.eyes[i].lens = lens;
    pair.eyes[i].world_from_eye = where.world_from_head * Pose{glm::dquat(1.0, 0.0, 0.0, 0.0), pupil};
  }
}

void LiveWearer::set_views(std::size_t pair, const HeadAndViews& where, const std::array<glm::dvec3, 2>& gaze,
                           const tracking::EyesInFrame& eyes) {
  std::size_t at = pair * setup_.sides.size();
  for (const Side side : setup_.sides) {
    const std::size_t i = index_of(side);
    setup_.pairs[pair].eyes[i].eye.pupil.x = eyes.pupil_diameter[i];
    render::ViewSetup& view = setup_.views[at++];
    view.eye.pupil.x = eyes.pupil_diameter[i];
    view.world_from_eye = setup_.pairs[pair].eyes[i].world_from_eye;
    view.view = where.eyes[i];
    view.view.gaze = gaze[i];
    if (setup_.viewing == render::Viewing::gaze) {
      view.accommodation = eyes.accommodation[i];
    }
  }
}

void LiveWearer::step(double time, const HeadAndViews& where, const std::optional<tracking::GazeSample>& sample) {
  const lenses::f64::Table table{setup_.lenses.table};
  for (std::size_t i = 0; i < setup_.pairs.size(); ++i) {
    WornPair& pair = setup_.pairs[i];
    hang(pair, where);
    const auto look = [&](const tracking::LookRequest& request) {
      pair.fixation = render::look(table, pair.eyes, setup_.viewing, request, setup_.wearer.live.gaze.noise, scene_);
      return render::looked_at(pair.fixation);
    };
    const tracking::EyeState& state = states_[i].step(
        {.time = time, .world_from_head = where.world_from_head, .sample = sample, .settled_pupil = settled_pupil_},
        look);
    set_views(i, where, state.gaze, {state.pupil_diameter, state.accommodation});
  }
}

void LiveWearer::place(const HeadAndViews& where, const std::array<glm::dvec3, 2>& gaze,
                       const tracking::EyesInFrame& eyes) {
  hang(setup_.pairs.front(), where);
  set_views(0, where, gaze, eyes);
}

}  // namespace app
