#include "app/vr/world.hpp"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <iostream>

#include "app/mode_option.hpp"
#include "app/option_values.hpp"
#include "app/vr/recording.hpp"
#include "app/vr/setup.hpp"

namespace app {
namespace {

SceneOptions scene_options(const VrOptions& options) {
  SceneOptions scene = options.scene;
  scene.in_headset = true;
  scene.bare_too = true;
  return scene;
}

}  // namespace

VrWorld::VrWorld(const VrOptions& options)
    : options_(options),
      replay_(options.replay.empty() ? std::nullopt : std::optional<SessionReplay>(options.replay)),
      scene_(render::read_gltf(options.scene.scene.empty() ? built_in_scene().string() : options.scene.scene)),
      wearer_(make_render_setup(scene_options(options), scene_), scene_),
      shown_(choices_of(options, scene_)) {
  (void)live_config(options, mode_of(options.mode));  // its range
  if (replay_) {
    check_pictures(*replay_, wearer_.all().pairs.size());
    rungs_ = rung_choice(options, replay_, false);
  }
  show(shown_.picture());
}

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

void VrWorld::watch_reprojection(double time, const HeadAndViews& where, double period) {
  if (replay_) {
    return;  // that head was another day's
  }
  reprojection_.see(time, where.world_from_head);
  const double error = reprojection_.error(wearer_.setup().lenses, wearer_.setup().pairs, wearer_.state().gaze, period);
  report_.head_speed.add(glm::degrees(glm::length(reprojection_.head_turn())));
  report_.reprojection_error.add(glm::degrees(error) * 60.0);
}

void VrWorld::choose_rungs(bool tracks_gaze) {
  if (!rungs_) {
    rungs_ = rung_choice(options_, replay_, tracks_gaze);
  }
}

void VrWorld::turned(const glm::dquat& new_from_old) {
  wearer_.turn_world(new_from_old);
  reprojection_.forget();
}

void VrWorld::apply(xr::Control control) {
  if (!replay_ && shown_.apply(control)) {
    record_event(std::string(xr::name(control)));
  }
}

void VrWorld::show(const ShownPicture& picture) {
  picture_ = picture;
  wearer_.wear(picture_.pairs);
}

std::size_t VrWorld::rung() const {
  return has_rungs(picture_) ? rungs_->rung() : 0;
}

bool VrWorld::has_rungs(const ShownPicture& picture) const {
  return replay_ || picture.mode == shown_.base();
}

void VrWorld::see_frame_time(const ShownPicture& picture, std::size_t rung, double seconds) {
  if (has_rungs(picture)) {
    rungs_->see(last_time_, rung, seconds);
  }
}

void VrWorld::place(double time, const HeadAndViews& now, std::optional<tracking::GazeSample> sample) {
  if (replay_) {
    replay_place(now);
    return;
  }
  const HeadAndViews where = steadied(now, wearer_.views());
  if (sample && sample->time) {
    *sample->time += session_from_runtime_;
  }
  show(shown_.picture());
  const auto& target = shown_.target();
  wearer_.step(time, where, sample, target ? std::optional(scene_.targets[*target].position) : std::nullopt);
  if (recorder_) {
    recorder_->frame(trace_row(time, where, wearer_, sample && sample->valid), recorded_views(where), rung_name(),
                     pair_name(), recorded_picture(picture_));
  }
  count_picture(source_text());
}

void VrWorld::replay_place(const HeadAndViews& now) {
  const SessionReplay::Frame frame = replay_->frame(static_cast<std::size_t>(report_.shown));
  if (const auto picture = replayed_picture(frame)) {
    show(*picture);
  }
  replay_frame(wearer_, frame, now);
  if (frame.rung != nullptr) {
    rungs_->use_named(*frame.rung);
  }
  count_picture("replay");
}

void VrWorld::count_picture(const std::string& source) {
  ++report_.gaze_sources[source];
  ++report_.pictures[picture_text()];
  ++report_.rungs[rung_name()];
  report_.rung_switches = rungs_->switches();
  report_.rung_reason = rungs_->reason();
}

std::string VrWorld::pair_name() const {
  const std::vector<WornPair>& pairs = wearer_.setup().pairs;
  return pairs.size() > 1 ? pairs[0].name + " | " + pairs[1].name : pairs[0].name;
}

std::string VrWorld::picture_text() const {
  if (picture_.mode == shown_.base()) {
    return pair_name();
  }
  const bool map = render::is_map(picture_.mode);
  return pair_name() + ", " + mode_names()[static_cast<std::size_t>(picture_.mode)] + (map ? " map" : "");
}

std::string VrWorld::source_text() const {
  const tracking::GazeSource source = wearer_.source();
  std::string text = tracking::name(source);
  if (source == tracking::GazeSource::target) {
    text += " " + target_name();
  }
  return text;
}

std::string VrWorld::target_name() const {
  return shown_.target() ? scene_.targets[*shown_.target()].name : "";
}

void VrWorld::warn(double views_apart) {
  const RenderSetup& setup = wearer_.setup();
  report_.findings = viewer_report(setup);
  std::array<double, 2> power{};
  for (const std::size_t i : {0U, 1U}) {
    power[i] = horizontal_power(lenses::f64::Table{setup.lenses.table}, setup.pairs.front().eyes[i]);
  }
  if (const auto finding = lenses::distance_finding(setup.wearer, views_apart, power)) {
    report_.findings.push_back({"", *finding});
  }
  std::cerr << to_table(report_.findings);
}

}  // namespace app
