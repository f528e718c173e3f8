// What a session in the headset is about: scene, wearer and spectacles, what is recorded or replayed, and the report.
// It knows no runtime, so it outlives any.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "app/recording/session_recorder.hpp"
#include "app/recording/session_replay.hpp"
#include "app/vr/live_wearer.hpp"
#include "app/vr/options.hpp"
#include "app/vr/report.hpp"
#include "app/vr/reprojection_watch.hpp"
#include "render/live_frame.hpp"

namespace app {

class VrWorld {
 public:
  // Refers to the options. Throws tracking::InputError for what files and options hold.
  explicit VrWorld(const VrOptions& options);

  [[nodiscard]] const VrOptions& options() const { return options_; }
  [[nodiscard]] const std::optional<SessionReplay>& replay() const { return replay_; }
  [[nodiscard]] const render::Scene& scene() const { return scene_; }
  [[nodiscard]] const RenderSetup& setup() const { return wearer_.setup(); }
  // Sizes, eyes, pairs and the guard band are for the pictures to say.
  [[nodiscard]] const render::LiveConfig& config() const { return config_; }
  [[nodiscard]] VrReport& report() { return report_; }
  [[nodiscard]] const VrReport& report() const { return report_; }

  // Of the picture placed last: as tracking::name has it, or "replay".
  [[nodiscard]] std::string gaze_source() const { return replay_ ? "replay" : tracking::name(wearer_.state().source); }

  // As many pictures as were asked for have been shown.
  [[nodiscard]] bool is_finished() const;

  // From the first runtime on; those after it go on with the same recording.
  void begin_recording(const std::string& device, const std::array<int, 2>& size);
  void record_event(const std::string& what);

  // Head and eyes of the picture to come, at its time (s, the session's) in the headset or as a replay has them; the
  // sample's time is the runtime's.
  void place(double time, const HeadAndViews& where, std::optional<tracking::GazeSample> sample);

  // How fast the head turns, and what reprojection by a frame's period (s) then gets wrong: into the report.
  void watch_reprojection(double time, const HeadAndViews& where, double period);
  // Not by itself: the space it is seen in was recentred.
  void head_was_moved() { reprojection_.forget(); }

  // What the person inside should know, before the first picture and again in the report. views_apart: m, between the
  // headset's two views, as its lenses stand; the wearer's spectacles stand as the wearer's pupils would.
  void warn(double views_apart);

  // From a runtime's time (s) to the session's, which is the first runtime's and goes on where another begins anew. To
  // be asked for every frame; a frame without a time (0) has that of the last.
  [[nodiscard]] double session_time(double runtime_time);
  // The next frame's time is another runtime's.
  void runtime_returned();

 private:
  const VrOptions& options_;
  std::optional<SessionReplay> replay_;
  render::Scene scene_;
  LiveWearer wearer_;
  render::LiveConfig config_;
  std::optional<SessionRecorder> recorder_;
  ReprojectionWatch reprojection_;
  VrReport report_;
  double last_time_ = 0.0;                            // s, of the last frame
  std::chrono::steady_clock::time_point last_frame_;  // when that was
  double session_from_runtime_ = 0.0;                 // s, added to a runtime's time
  bool is_new_clock_ = false;
};

}  // namespace app
