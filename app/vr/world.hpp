// What a session in the headset is about: scene, wearer and pairs of spectacles, what is worn and shown of them, what
// is recorded or replayed, and the report. It knows no runtime, so it outlives any.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "app/recording/session_recorder.hpp"
#include "app/recording/session_replay.hpp"
#include "app/vr/live_wearer.hpp"
#include "app/vr/options.hpp"
#include "app/vr/report.hpp"
#include "app/vr/reprojection_watch.hpp"
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
  [[nodiscard]] const VrReport& report() const { return report_; }

  // With the pairs worn.
  [[nodiscard]] const RenderSetup& setup() const { return wearer_.setup(); }

  // Of the picture placed last: where its gaze comes from, as tracking::name has it, or "replay"; the name of the rung
  // it is drawn at; the map that lies over it and the target that was chosen, empty for none.
  [[nodiscard]] std::string gaze_source() const { return replay_ ? "replay" : tracking::name(wearer_.source()); }
  [[nodiscard]] std::string rung_name() const { return rungs_->rungs()[rung()].name; }
  [[nodiscard]] std::string map_name() const;
  [[nodiscard]] std::string target_name() const;

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
  void turned(const glm::dquat& new_from_old);

  // Head and eyes of the picture to come, at its time (s, the session's) in the headset or as a replay has them; the
  // sample's time is the runtime's.
  void place(double time, const HeadAndViews& now, std::optional<tracking::GazeSample> sample);
  // What that picture shows, and at which of the rungs.
  [[nodiscard]] const ShownPicture& picture() const { return picture_; }
  [[nodiscard]] std::size_t rung() const;
  // Whether it is drawn at any rung; else at the first alone: maps and the clear view are always drawn in full.
  [[nodiscard]] bool has_rungs(const ShownPicture& picture) const;
  // What a picture took on the device (s), for the rungs of those to come.
  void see_frame_time(const ShownPicture& picture, std::size_t rung, double seconds);
  // Every picture that may come.
  [[nodiscard]] std::vector<ShownPicture> reachable() const { return shown_.reachable(); }

  // How fast the head turns, and what reprojection by a frame's period (s) then gets wrong: into the report.
  void watch_reprojection(double time, const HeadAndViews& where, double period);

  // What the person inside should know, before the first picture, with every other pair that is put on, and again in
  // the report. views_apart: m, between the headset's two views, as its lenses stand; the wearer's spectacles stand as
  // the wearer's pupils would.
  void warn(double views_apart);
  // Of the pairs worn.
  [[nodiscard]] const std::vector<ViewerFinding>& warnings() const { return warnings_; }
  [[nodiscard]] bool is_clear() const { return shown_.is_clear(); }

  // From a runtime's time (s) to the session's, which is the first runtime's and goes on where another begins anew.
  // To be asked for every frame; a frame without a time (0) has that of the last.
  [[nodiscard]] double session_time(double runtime_time);
  // The next frame's time is another runtime's.
  void runtime_returned();

 private:
  void replay_place(const HeadAndViews& now);
  void show(const ShownPicture& picture);
  void find_warnings();
  void count_picture(const std::string& source);
  [[nodiscard]] std::string pair_name() const;
  [[nodiscard]] std::string picture_text() const;

  const VrOptions& options_;
  std::optional<SessionReplay> replay_;
  render::Scene scene_;
  LiveWearer wearer_;
  Shown shown_;
  ShownPicture picture_;
  std::optional<RungChoice> rungs_;  // once it is known whether gaze is tracked
  std::optional<SessionRecorder> recorder_;
  ReprojectionWatch reprojection_;
  VrReport report_;
  std::optional<double> views_apart_;   // m; nothing before the first picture
  std::vector<std::size_t> warned_of_;  // the pairs of the warnings
  std::vector<ViewerFinding> warnings_;
  double last_time_ = 0.0;                            // s, of the last frame
  std::chrono::steady_clock::time_point last_frame_;  // when that was
  double session_from_runtime_ = 0.0;                 // s, added to a runtime's time
  bool is_new_clock_ = false;
};

}  // namespace app
