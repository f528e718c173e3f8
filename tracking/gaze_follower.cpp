#include "tracking/gaze_follower.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <numbers>

#include "tracking/direction.hpp"

namespace tracking {
namespace {

const glm::dvec3 kAhead(0.0, 0.0, -1.0);

constexpr double kStale = 0.1;         // s without a new sample, the slowest trackers' period and more
constexpr double kClockReset = 1.0;    // s: a sample so much older than the last one is of a clock that began anew
constexpr double kHeadHistory = 0.25;  // s, more than trackers are late
constexpr double kFarthestTurn = 50.0 * std::numbers::pi / 180.0;  // that an eye makes in its socket

glm::dvec3 within_reach(const glm::dvec3& direction) {
  const double angle = angle_between(kAhead, direction);
  return angle <= kFarthestTurn ? direction : turned_towards(kAhead, direction, kFarthestTurn / angle);
}

}  // namespace

GazeFollower::GazeFollower(const GazeConfig& config)
    : config_(config),
      target_{DirectionFilter(config.target), DirectionFilter(config.target)},
      pupil_{DirectionFilter(config.pupil), DirectionFilter(config.pupil)},
      detector_(config.saccade) {
  gaze_.age = std::numeric_limits<double>::infinity();
}

std::optional<GazeFollower::Lines> GazeFollower::lines_of(const GazeSample& sample) {
  if (!sample.valid) {
    return std::nullopt;
  }
  std::array<std::optional<glm::dvec3>, 2> eye;
  for (std::size_t i = 0; i < 2; ++i) {
    eye[i] = sample.eye[i] ? unit_direction(*sample.eye[i]) : std::nullopt;
  }
  if (eye[0] && eye[1]) {
    return Lines{true, glm::dvec3(0.0), {*eye[0], *eye[1]}};
  }
  if (sample.combined) {
    const auto direction = unit_direction(sample.combined->direction);
    const glm::dvec3 origin = sample.combined->origin;
    if (direction && std::isfinite(origin.x + origin.y + origin.z)) {
      return Lines{false, origin, {*direction, *direction}};
    }
  }
  if (const auto& only = eye[0] ? eye[0] : eye[1]) {
    return Lines{false, glm::dvec3(0.0), {*only, *only}};
  }
  return std::nullopt;
}

void GazeFollower::remember_head(double time, const glm::dquat& world_from_head) {
  heads_.push_back({time, world_from_head});
  while (heads_.size() > 2 && time - heads_[1].time > kHeadHistory) {
    heads_.pop_front();
  }
}

// The head's orientation when a sample was measured: with the present one, a head that turns at 100 deg/s would carry a
// sample of 60 ms ago 6 degrees away.
glm::dquat GazeFollower::head_at(double time) const {
  const auto later = std::ranges::find_if(heads_, [&](const Heading& h) { return h.time >= time; });
  if (later == heads_.end()) {
    return heads_.back().world_from_head;
  }
  if (later == heads_.begin()) {
    return later->world_from_head;
  }
  const Heading& before = *std::prev(later);
  return glm::slerp(before.world_from_head, later->world_from_head, (time - before.time) / (later->time - before.time));
}

bool GazeFollower::is_new(double sample_time) const {
  return !sample_time_ || sample_time > *sample_time_ || sample_time < *sample_time_ - kClockReset;
}

// After a blink the eye is mostly where it was, and a tracker that misses single samples must not shake the picture.
bool GazeFollower::is_elsewhere(const glm::dvec3& direction) const {
  const glm::dvec3 held = *target_[0].value() + *target_[1].value();
  return angle_between(unit_direction(held).value_or(direction), direction) >
         detector_.threshold() * config_.saccade.window;
}

void GazeFollower::take(double time, double sample_time, const Lines& lines) {
  const glm::dquat world_from_head = head_at(sample_time);
  const glm::dvec3 middle = unit_direction(lines.direction[0] + lines.direction[1]).value_or(lines.direction[0]);
  const bool anew = gaze_.source == GazeSource::head || lines.two != gaze_.two_lines ||
                    (sample_time_ && sample_time < *sample_time_) ||
                    (gaze_.source == GazeSource::held && is_elsewhere(world_from_head * middle));
  if (anew) {
    detector_.restart();
  }
  gaze_.phase = detector_.see(sample_time, world_from_head * middle);
  gaze_.jumped = anew || gaze_.phase == GazePhase::saccade;
  for (std::size_t i = 0; i < 2; ++i) {
    if (gaze_.jumped) {
      target_[i].restart();
      pupil_[i].restart();
    }
    const glm::dvec3 direction = world_from_head * lines.direction[i];
    target_[i].see(sample_time, direction);
    pupil_[i].see(sample_time, direction);
  }
  gaze_.two_lines = lines.two;
  gaze_.origin = lines.origin;
  gaze_.source = GazeSource::tracker;
  sample_time_ = sample_time;
  seen_ = time;
}

// The filtered directions in the present head's axes: an eye on a target counters the head's turn, without lag.
void GazeFollower::report_world() {
  const glm::dquat head_from_world = glm::conjugate(heads_.back().world_from_head);
  for (std::size_t i = 0; i < 2; ++i) {
    gaze_.target[i] = within_reach(head_from_world * *target_[i].value());
    gaze_.pupil[i] = within_reach(head_from_world * *pupil_[i].value());
  }
}

void GazeFollower::return_to_head(double interval) {
  const double rest = config_.return_time_constant > 0.0 ? -std::expm1(-interval / config_.return_time_constant) : 1.0;
  for (std::size_t i = 0; i < 2; ++i) {
    gaze_.target[i] = turned_towards(gaze_.target[i], kAhead, rest);
    gaze_.pupil[i] = turned_towards(gaze_.pupil[i], kAhead, rest);
  }
}

void GazeFollower::turn_world(const glm::dquat& new_from_old) {
  for (Heading& heading : heads_) {
    heading.world_from_head = new_from_old * heading.world_from_head;
  }
  for (std::size_t i = 0; i < 2; ++i) {
    target_[i].turn(new_from_old);
    pupil_[i].turn(new_from_old);
  }
  detector_.turn(new_from_old);
}

FollowedGaze GazeFollower::step(double time, const Pose& world_from_head, const std::optional<GazeSample>& sample) {
  if (!std::isfinite(time) || (time_ && time < *time_)) {
    return gaze_;
  }
  const double interval = time_ ? time - *time_ : 0.0;
  time_ = time;
  const double length = glm::length(world_from_head.orientation);
  const bool good = world_from_head.is_finite() && length > 0.5 && length < 2.0;
  remember_head(time, good             ? glm::normalize(world_from_head.orientation)
                      : heads_.empty() ? glm::dquat(1.0, 0.0, 0.0, 0.0)
                                       : heads_.back().world_from_head);
  gaze_.jumped = false;
  const std::optional<Lines> lines = sample ? lines_of(*sample) : std::nullopt;
  const double sample_time = sample && sample->time && std::isfinite(*sample->time) ? *sample->time : time;
  if (lines && is_new(sample_time)) {
    take(time, sample_time, *lines);
  }
  gaze_.age = seen_ ? time - *seen_ : std::numeric_limits<double>::infinity();
  if (!seen_ || gaze_.age > config_.hold) {
    // What the hold left over in this frame goes into the return, so that frames of any length make the same way.
    const double beyond = seen_ ? std::min(interval, gaze_.age - config_.hold) : interval;
    gaze_.source = GazeSource::head;
    gaze_.phase = GazePhase::fixation;
    return_to_head(beyond);
    return gaze_;
  }
  const bool lost = (sample && !lines) || gaze_.age > kStale;
  if (lost) {
    gaze_.source = GazeSource::held;
    gaze_.phase = GazePhase::fixation;
  }
  report_world();
  return gaze_;
}

}  // namespace tracking
