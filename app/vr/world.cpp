#include "app/vr/world.hpp"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <iostream>

#include "app/option_values.hpp"
#include "app/vr/recording.hpp"
#include "app/vr/setup.hpp"

namespace app {
namespace {

SceneOptions scene_options(const VrOptions& options) {
  SceneOptions scene = options.scene;
  scene.in_headset = true;
  return scene;
}

}  // namespace

VrWorld::VrWorld(const VrOptions& options)
    : options_(options),
      replay_(options.replay.empty() ? std::nullopt : std::optional<SessionReplay>(options.replay)),
      scene_(render::read_gltf(options.scene.scene.empty() ? built_in_scene().string() : options.scene.scene)),
      wearer_(make_render_setup(scene_options(options), scene_), scene_),
      config_(live_config(options)) {}

bool VrWorld::is_finished() const {
  return (options_.frames && report_.shown >= *options_.frames) ||
         (replay_ && static_cast<std::size_t>(report_.shown) >= replay_->frames());
}

void VrWorld::begin_recording(const std::string& device, const std::array<int, 2>& size) {
  if (options_.record.empty() || recorder_) {
    return;
  }
  SessionRecord record;
  record.device = device;
  record.size = size;
  record.options = recorded_options(options_);
  recorder_.emplace(options_.record, std::move(record));
}

void VrWorld::record_event(const std::string& what) {
  if (recorder_) {
    recorder_->event(last_time_, what);
  }
}

double VrWorld::session_time(double runtime_time) {
  if (runtime_time <= 0.0) {
    return last_time_;
  }
  const auto now = std::chrono::steady_clock::now();
  if (is_new_clock_) {
    session_from_runtime_ = last_time_ + std::chrono::duration<double>(now - last_frame_).count() - runtime_time;
    is_new_clock_ = false;
  }
  last_time_ = runtime_time + session_from_runtime_;
  last_frame_ = now;
  return last_time_;
}

void VrWorld::runtime_returned() {
  is_new_clock_ = true;
  reprojection_.forget();
  record_event("runtime returned");
  ++report_.reconnections;
}

void VrWorld::place(double time, const HeadAndViews& where, std::optional<tracking::GazeSample> sample) {
  if (replay_) {
    replay_frame(wearer_, replay_->frame(static_cast<std::size_t>(report_.shown)), where);
    ++report_.gaze_sources["replay"];
    return;
  }
  if (sample && sample->time) {
    *sample->time += session_from_runtime_;
  }
  wearer_.step(time, where, sample);
  ++report_.gaze_sources[tracking::name(wearer_.state().source)];
  if (recorder_) {
    recorder_->frame(trace_row(time, where, wearer_, sample && sample->valid), recorded_views(where),
                     options_.picture.accuracy, setup().pairs.front().name);
  }
}

void VrWorld::watch_reprojection(double time, const HeadAndViews& where, double period) {
  if (replay_) {
    return;  // that head was another day's
  }
  reprojection_.see(time, where.world_from_head);
  const double error = reprojection_.error(setup().lenses, setup().pairs, wearer_.state().gaze, period);
  report_.head_speed.add(glm::degrees(glm::length(reprojection_.head_turn())));
  report_.reprojection_error.add(glm::degrees(error) * 60.0);
}

void VrWorld::warn(double views_apart) {
  report_.findings = viewer_report(setup());
  std::array<double, 2> power{};
  for (const std::size_t i : {0U, 1U}) {
    power[i] = horizontal_power(lenses::f64::Table{setup().lenses.table}, setup().pairs.front().eyes[i]);
  }
  if (const auto finding = lenses::distance_finding(setup().wearer, views_apart, power)) {
    report_.findings.push_back({"", *finding});
  }
  std::cerr << to_table(report_.findings);
}

}  // namespace app
