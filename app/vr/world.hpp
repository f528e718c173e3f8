// What a session in the headset is about: scene, wearer and pairs of spectacles, what is worn and shown of them, what
// is recorded or replayed, and the report. It knows no runtime, so it outlives any.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/recording/session_recorder.hpp"
#include "app/recording/session_replay.hpp"
#include "app/vr/live_wearer.hpp"
#include "app/vr/options.hpp"
#include "app/vr/report.hpp"
#include "app/vr/rungs.hpp"
#include "app/vr/shown.hpp"

namespace app {

class VrWorld {
 public:
  // Refers to the options. Throws tracking::InputError for what files and options hold.
  explicit VrWorld(const VrOptions& options);

  [[nodiscard]] const VrOptions& options() const { return options_; }
  [[nodiscard]] const std::optional<SessionReplay>& replay() const { return replay_; }
  [[nodiscard]] const render::Scene& scene() const { return scene_; }
  [[nodiscard]] const LiveWearer& wearer() const { return wearer_; }
  [[nodiscard]] VrReport& report() { return report_; }

  // As many pictures as were asked for have been shown.
  [[nodiscard]] bool is_finished() const;

  // From the first runtime on; those after it go on with the same recording and at the same rung.
  void begin_recording(const std::string& device, const std::array<int, 2>& size);
  void record_event(const std::string& what);
  void choose_rungs(bool tracks_gaze);
  [[nodiscard]] RungChoice& rungs() { return *rungs_; }

  // What the wearer's hands ask for, but for recentring, which is for whoever knows where the head is.
  void apply(xr::Control control);
  // The scene was turned about the head.
  void turned(const glm::dquat& new_from_old) { wearer_.turn_world(new_from_old); }

  // Head and eyes of the picture to come, at its time (s) in the headset or as a replay has them.
  void place(double time, const HeadAndViews& now, const std::optional<tracking::GazeSample>& sample);
  // What that picture shows, and at which of the rungs.
  [[nodiscard]] const ShownPicture& picture() const { return picture_; }
  [[nodiscard]] std::size_t rung() const;
  // Whether it is drawn at any rung; else at the first alone: maps and the clear view are always drawn in full.
  [[nodiscard]] bool has_rungs(const ShownPicture& picture) const;
  // What a picture took on the device (s), for the rungs of those to come.
  void see_frame_time(const ShownPicture& picture, std::size_t rung, double seconds);
  // Every picture that may come.
  [[nodiscard]] std::vector<ShownPicture> reachable() const { return shown_.reachable(); }

  // What the person inside should know, before the first picture and again in the report. views_apart: m, between the
  // headset's two views, as its lenses stand; the wearer's spectacles stand as the wearer's pupils would.
  void warn(double views_apart);
  // A line each for the person inside: what is worn and shown, where the gaze comes from, at what is looked, and how
  // exactly it is drawn.
  [[nodiscard]] std::vector<std::string> live_notes() const;

  // Something is known of this moment (s), if only that nothing was shown.
  void note_time(double time) { last_time_ = time; }

 private:
  void replay_place(const HeadAndViews& now);
  void show(const ShownPicture& picture);
  void count_picture(const std::string& source);
  [[nodiscard]] std::string pair_name() const;
  [[nodiscard]] std::string picture_text() const;
  [[nodiscard]] std::string source_text() const;

  const VrOptions& options_;
  std::optional<SessionReplay> replay_;
  render::Scene scene_;
  LiveWearer wearer_;
  Shown shown_;
  ShownPicture picture_;
  std::optional<RungChoice> rungs_;  // once it is known whether gaze is tracked
  std::optional<SessionRecorder> recorder_;
  VrReport report_;
  double last_time_ = 0.0;  // s, of the last frame
};

}  // namespace app
