#include "app/vr/world.hpp"

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

void VrWorld::place(double time, const HeadAndViews& where, const std::optional<tracking::GazeSample>& sample) {
  if (replay_) {
    replay_frame(wearer_, replay_->frame(static_cast<std::size_t>(report_.shown)), where);
    ++report_.gaze_sources["replay"];
    return;
  }
  wearer_.step(time, where, sample);
  ++report_.gaze_sources[tracking::name(wearer_.state().source)];
  if (recorder_) {
    recorder_->frame(trace_row(time, where, wearer_, sample && sample->valid), recorded_views(where),
                     options_.picture.accuracy, setup().pairs.front().name);
  }
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
