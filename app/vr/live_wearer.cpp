#include "app/vr/live_wearer.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <utility>

namespace app {
namespace {

using tracking::Pose;
using tracking::Side;

constexpr std::array kSides{Side::right, Side::left};
// m or rad; a hundredth of a pixel. Poses come as floats, of heads that may be metres from the origin.
constexpr double kRounding = 5e-6;
constexpr double kReach = 0.7071;  // cosine of what an eye turns in its socket

constexpr std::size_t index_of(Side side) {
  return static_cast<std::size_t>(side);
}

// rad, about each axis, of a small turn from b to a.
glm::dvec3 turned_by(const glm::dquat& a, const glm::dquat& b) {
  const glm::dquat turn = a * glm::conjugate(b);
  return 2.0 * (turn.w < 0.0 ? -1.0 : 1.0) * glm::dvec3(turn.x, turn.y, turn.z);
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

HeadAndViews steadied(HeadAndViews now, const std::array<tracking::EyeView, 2>& before) {
  const auto near = [](double a, double b) { return std::abs(a - b) <= kRounding; };
  for (std::size_t i = 0; i < 2; ++i) {
    const Pose &a = now.eyes[i].head_from_view, &b = before[i].head_from_view;
    const tracking::FieldOfView &f = now.eyes[i].fov, &g = before[i].fov;
    if (glm::length(a.position - b.position) <= kRounding &&
        glm::length(turned_by(a.orientation, b.orientation)) <= kRounding && near(f.tan_left, g.tan_left) &&
        near(f.tan_right, g.tan_right) && near(f.tan_down, g.tan_down) && near(f.tan_up, g.tan_up)) {
      now.eyes[i] = before[i];
    }
  }
  return now;
}

LiveWearer::LiveWearer(RenderSetup all, const render::Scene& scene)
    : all_(std::move(all)), query_(scene), scene_(render::scene_along(query_)) {
  for (const std::size_t i : {0U, 1U}) {
    settled_pupil_[i] = all_.pairs.front().eyes[i].eye.pupil.x;
    views_[i] = all_.views.front().view;
  }
  states_.push_back(start_state(all_, all_.pairs.front()));
  worn_ = {0};
  setup_ = wearing(worn_);
}

void LiveWearer::wear(std::span<const std::size_t> pairs) {
  if (std::ranges::equal(pairs, worn_)) {
    return;
  }
  std::vector<tracking::LiveState> states;
  for (const std::size_t pair : pairs) {
    const auto before = std::ranges::find(worn_, pair);
    states.push_back(states_[before == worn_.end() ? 0 : static_cast<std::size_t>(before - worn_.begin())]);
  }
  states_ = std::move(states);
  worn_.assign(pairs.begin(), pairs.end());
  setup_ = wearing(worn_);
}

RenderSetup LiveWearer::wearing(std::span<const std::size_t> pairs) const {
  RenderSetup setup = all_;
  setup.pairs.clear();
  setup.views.clear();
  for (const std::size_t pair : pairs) {
    setup.pairs.push_back(all_.pairs.at(pair));
    for (std::size_t side = 0; side < all_.sides.size(); ++side) {
      render::ViewSetup view = all_.views[pair * all_.sides.size() + side];
      const tracking::EyeView& now = views_[index_of(all_.sides[side])];
      view.view.head_from_view = now.head_from_view;
      view.view.fov = now.fov;
      setup.views.push_back(view);
    }
  }
  return setup;
}

tracking::GazeSource LiveWearer::source() const {
  return at_target_ && state().source == tracking::GazeSource::tracker ? tracking::GazeSource::target : state().source;
}

void LiveWearer::turn_world(const glm::dquat& new_from_old) {
  for (tracking::LiveState& state : states_) {
    state.turn_world(new_from_old);
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
    lens = all_.lenses.lens[pair.lens[i]];  // as it was fitted, for a pupil in its place
    if (lens.mount.x == 0) {                // on the head: a contact lens goes with its eye
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

void LiveWearer::set_views(std::size_t pair, const HeadAndViews& where, const EyesDrawn& drawn) {
  std::size_t at = pair * setup_.sides.size();
  for (const Side side : setup_.sides) {
    const std::size_t i = index_of(side);
    setup_.pairs[pair].eyes[i].eye.pupil.x = drawn.eyes.pupil_diameter[i];
    render::ViewSetup& view = setup_.views[at++];
    view.eye.pupil.x = drawn.eyes.pupil_diameter[i];
    view.world_from_eye = setup_.pairs[pair].eyes[i].world_from_eye;
    view.view = where.eyes[i];
    view.view.gaze = drawn.gaze[i];
    if (setup_.viewing == render::Viewing::gaze) {
      view.accommodation = drawn.eyes.accommodation[i];
    }
  }
}

// Each eye turned so that its line, through its lens, reaches the target.
tracking::GazeSample LiveWearer::looking_at(const WornPair& pair, const Pose& world_from_head,
                                            const glm::dvec3& target) const {
  const glm::dvec3 in_head = world_from_head.inverse().point(target);
  const double away = glm::length(in_head);
  tracking::GazeSample sample{.time = {}, .eye = {}, .combined = {}, .valid = -in_head.z > kReach * away};
  if (sample.valid) {
    const render::Fixation fixation =
        render::fixate(lenses::f64::Table{setup_.lenses.table}, pair.eyes, setup_.viewing, target, away);
    for (const std::size_t i : {0U, 1U}) {
      sample.eye[i] = fixation.line[i].gaze;
    }
  }
  return sample;
}

void LiveWearer::step(double time, const HeadAndViews& where, const std::optional<tracking::GazeSample>& sample,
                      const std::optional<glm::dvec3>& target) {
  views_ = where.eyes;
  at_target_ = target && !sample;
  const lenses::f64::Table table{setup_.lenses.table};
  for (std::size_t i = 0; i < setup_.pairs.size(); ++i) {
    WornPair& pair = setup_.pairs[i];
    hang(pair, where);
    const auto look = [&](const tracking::LookRequest& request) {
      pair.fixation = render::look(table, pair.eyes, setup_.viewing, request, setup_.wearer.live.gaze.noise, scene_);
      return render::looked_at(pair.fixation);
    };
    const tracking::EyeState& state =
        states_[i].step({.time = time,
                         .world_from_head = where.world_from_head,
                         .sample = at_target_ ? looking_at(pair, where.world_from_head, *target) : sample,
                         .settled_pupil = settled_pupil_},
                        look);
    set_views(i, where, {state.gaze, {state.pupil_diameter, state.accommodation}});
  }
}

void LiveWearer::place(const HeadAndViews& where, std::span<const EyesDrawn> eyes) {
  views_ = where.eyes;
  for (std::size_t i = 0; i < setup_.pairs.size(); ++i) {
    hang(setup_.pairs[i], where);
    set_views(i, where, eyes[i]);
  }
}

}  // namespace app
