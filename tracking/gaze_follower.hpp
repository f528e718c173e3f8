// From a tracker's samples to where the eyes look at the time of a frame: filtered, through blinks and losses, and
// honest about its source. Samples may be late, early, repeated, out of order, or missing.
#pragma once

#include <array>
#include <deque>
#include <glm/vec3.hpp>
#include <optional>

#include "tracking/direction_filter.hpp"
#include "tracking/fixation_distance.hpp"
#include "tracking/live_config.hpp"
#include "tracking/saccade_detector.hpp"
#include "tracking/stereo_view.hpp"

namespace tracking {

// What a tracker says, in head axes; directions of any length. One that is not finite or has no length is not there.
struct GazeSample {
  std::optional<double> time;                    // s, when it was measured, in the frames' clock; nothing: not known
  std::array<std::optional<glm::dvec3>, 2> eye;  // each eye's own direction, indexed by Side
  std::optional<Line> combined;                  // one line for both; counts where an eye's own is missing
  bool valid = true;                             // false during blinks and loss
};

enum class GazeSource {
  tracker,  // a sample is at most as old as trackers are late
  held,     // the last one, kept through a blink or a loss
  head,     // nothing to go by: straight ahead, reached smoothly
  target    // no tracker: at a thing of the scene, as the wearer chose
};

inline constexpr std::array kGazeSources{GazeSource::tracker, GazeSource::held, GazeSource::head, GazeSource::target};

[[nodiscard]] constexpr const char* name(GazeSource source) {
  constexpr std::array kNames{"tracker", "held", "head", "target"};  // in the order of the enumeration
  return kNames[static_cast<std::size_t>(source)];
}

// Directions are unit, in head axes, before the lens, indexed by Side; with one line for both eyes they are equal.
struct FollowedGaze {
  GazeSource source = GazeSource::head;
  GazePhase phase = GazePhase::fixation;
  bool jumped = false;     // in this frame the eyes made for elsewhere: a saccade, or the tracker came back
  bool two_lines = false;  // each eye's own direction, so that vergence is known
  glm::dvec3 origin{0.0};  // of one line for both, m, head axes
  std::array<glm::dvec3, 2> target{glm::dvec3(0.0, 0.0, -1.0), glm::dvec3(0.0, 0.0, -1.0)};
  std::array<glm::dvec3, 2> pupil = target;  // far steadier: where the eyes are turned as far as the optics go
  double age = 0.0;                          // s since the last sample; infinite before the first
};

class GazeFollower {
 public:
  explicit GazeFollower(const GazeConfig& config = {});

  // The gaze at a frame's time. `sample`: the latest that the tracker has, new or not; nothing: none. A time that is
  // not finite or lies before the last frame's gives the last answer again; a pose that is not finite is taken as
  // unchanged.
  FollowedGaze step(double time, const Pose& world_from_head, const std::optional<GazeSample>& sample);

  // The world has turned about the head (the scene was recentred): the eyes stay as they were in the head.
  void turn_world(const glm::dquat& new_from_old);

 private:
  struct Lines {
    bool two = false;
    glm::dvec3 origin{0.0};
    std::array<glm::dvec3, 2> direction;  // unit, head axes
  };
  struct Heading {
    double time;
    glm::dquat world_from_head;
  };

  [[nodiscard]] static std::optional<Lines> lines_of(const GazeSample& sample);
  void remember_head(double time, const glm::dquat& world_from_head);
  [[nodiscard]] glm::dquat head_at(double time) const;
  [[nodiscard]] bool is_new(double sample_time) const;
  [[nodiscard]] bool is_elsewhere(const glm::dvec3& direction) const;
  void take(double time, double sample_time, const Lines& lines);
  void report_world();
  void return_to_head(double interval);

  GazeConfig config_;
  std::array<DirectionFilter, 2> target_, pupil_;  // world axes
  SaccadeDetector detector_;
  std::deque<Heading> heads_;
  std::optional<double> sample_time_;  // of the last sample taken
  std::optional<double> seen_;         // the frame's time then
  std::optional<double> time_;         // the last frame's
  FollowedGaze gaze_;
};

}  // namespace tracking
