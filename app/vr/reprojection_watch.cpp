#include "app/vr/reprojection_watch.hpp"

#include <algorithm>
#include <glm/gtc/quaternion.hpp>

#include "lenses/reprojection.hpp"
#include "tracking/stereo_view.hpp"

namespace app {
namespace {

constexpr double kPause_s = 0.25;  // longer without a frame: what the head did in between is not known

}  // namespace

void ReprojectionWatch::see(double time, const tracking::Pose& world_from_head) {
  const Seen now{time, world_from_head.orientation};
  turn_ = glm::dvec3(0.0);
  known_ = last_ && time > last_->time && time - last_->time <= kPause_s;
  if (known_) {
    glm::dquat turned = glm::conjugate(last_->orientation) * now.orientation;
    if (turned.w < 0.0) {
      turned = -turned;  // the same rotation, the short way
    }
    const double angle = glm::angle(turned);
    if (angle > 0.0) {
      turn_ = glm::axis(turned) * (angle / (time - last_->time));
    }
  }
  last_ = now;
}

double ReprojectionWatch::error(const lenses::LensModel& lenses, std::span<const WornPair> pairs,
                                const std::array<glm::dvec3, 2>& gaze, double late) const {
  double largest = 0.0;
  const lenses::f64::Table table{lenses.table};
  for (const WornPair& pair : pairs) {
    for (const std::size_t side : {0U, 1U}) {
      const render::EyeOptics& eye = pair.eyes[side];
      const auto line = lenses::f64::trace_sight_line(table, eye.lens, eye.eye, tracking::listing_rotation(gaze[side]),
                                                      gaze[side], glm::dvec2(0.0), glm::dvec2(0.0));
      if (line.status == lenses::f64::kStatusOk && eye.lens.glass.w != 0.0) {
        largest = std::max(largest, glm::length(lenses::reprojection_error(eye.lens, line, turn_ * late)));
      }
    }
  }
  return largest;
}

}  // namespace app
