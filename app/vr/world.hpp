// What a session in the headset is about: scene, wearer and spectacles, what is recorded or replayed, and the report.
// It knows no runtime, so it outlives any.
#pragma once

#include <optional>
#include <string>

#include "app/recording/session_recorder.hpp"
#include "app/recording/session_replay.hpp"
#include "app/vr/live_wearer.hpp"
#include "app/vr/options.hpp"
#include "app/vr/report.hpp"
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

  // As many pictures as were asked for have been shown.
  [[nodiscard]] bool is_finished() const;

  // From the first runtime on; those after it go on with the same recording.
  void begin_recording(const std::string& device, const std::array<int, 2>& size);
  void record_event(const std::string& what);

  // Head and eyes of the picture to come, at its time (s) in the headset or as a replay has them.
  void place(double time, const HeadAndViews& where, const std::optional<tracking::GazeSample>& sample);

  // What the person inside should know, before the first picture and again in the report. views_apart: m, between the
  // headset's two views, as its lenses stand; the wearer's spectacles stand as the wearer's pupils would.
  void warn(double views_apart);

  // Something is known of this moment (s), if only that nothing was shown.
  void note_time(double time) { last_time_ = time; }

 private:
  const VrOptions& options_;
  std::optional<SessionReplay> replay_;
  render::Scene scene_;
  LiveWearer wearer_;
  render::LiveConfig config_;
  std::optional<SessionRecorder> recorder_;
  VrReport report_;
  double last_time_ = 0.0;  // s, of the last frame
};

}  // namespace app
