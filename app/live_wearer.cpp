#include "app/live_wearer.hpp"

#include <utility>

namespace app {
namespace {

using tracking::Pose;
using tracking::Side;

constexpr std::array kSides{Side::right, Side::left};

constexpr std::size_t index_of(Side side) {
  return static_cast<std::size_t>(side);
}

}  // namespace

LiveWearer::LiveWearer(RenderSetup setup, const render::Scene& scene)
    : setup_(std::move(setup)), fitted_(setup_.lenses.lens), query_(scene) {}

glm::dvec3 LiveWearer::pupil_of(const Sighting& sighting, Side side) const {
  const glm::dvec3 origin = sighting.eyes[index_of(side)].head_from_view.position;
  const bool behind =
      setup_.headset && setup_.headset->view_origin == lenses::HeadsetDisplay::ViewOrigin::rotation_centre;
  return behind ? origin - glm::dvec3(0.0, 0.0, setup_.pairs.front().eyes[index_of(side)].eye.pupil.y) : origin;
}

void LiveWearer::place_pair(WornPair& pair, const Sighting& sighting) {
  const glm::dvec3 nose = 0.5 * (pupil_of(sighting, Side::right) + pupil_of(sighting, Side::left));
  for (const Side side : kSides) {
    const std::size_t i = index_of(side);
    const glm::dvec3 pupil = pupil_of(sighting, side);
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
    pair.eyes[i].world_from_eye = sighting.world_from_head * Pose{glm::dquat(1.0, 0.0, 0.0, 0.0), pupil};
  }
  const lenses::f64::Table table{setup_.lenses.table};
  pair.fixation = setup_.viewing == render::Viewing::gaze
                      ? render::fixate_along(table, pair.eyes, setup_.viewing, sighting.gaze, query_)
                      : render::look_parallel(table, pair.eyes, setup_.viewing, sighting.gaze, query_);
}

void LiveWearer::place(const Sighting& sighting) {
  std::size_t at = 0;
  for (WornPair& pair : setup_.pairs) {
    place_pair(pair, sighting);
    for (const Side side : setup_.sides) {
      const std::size_t i = index_of(side);
      render::ViewSetup& view = setup_.views[at++];
      view.world_from_eye = pair.eyes[i].world_from_eye;
      view.view = sighting.eyes[i];
      view.view.gaze = pair.fixation.line[i].gaze;
      if (setup_.viewing == render::Viewing::gaze) {
        view.accommodation = pair.fixation.accommodation[i];
      }
    }
  }
}

}  // namespace app
