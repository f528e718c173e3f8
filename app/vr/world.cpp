#include "app/vr/world.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <iostream>

#include "app/mode_option.hpp"
#include "app/option_values.hpp"
#include "app/vr/recording.hpp"
#include "app/vr/setup.hpp"

namespace app {
namespace {

constexpr const char* kPrism = "vertical_prism";  // see lenses::Finding

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
  started_with_ = picture_.pairs;
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
  if (picture.pairs != picture_.pairs) {
    prism_.forget();
  }
  picture_ = picture;
  wearer_.wear(picture_.pairs);
}

std::size_t VrWorld::rung() const {
  return rungs_of(picture_) > 1 ? rungs_->rung() : 0;
}

std::size_t VrWorld::rungs_of(const ShownPicture& picture) const {
  return replay_ || picture.mode == shown_.base() ? rungs_->rungs().size() : 1;
}

std::vector<ShownPicture> VrWorld::reachable() const {
  return replay_ ? replayed_pictures(*replay_, shown_.picture()) : shown_.reachable();
}

void VrWorld::see_frame_time(const ShownPicture& picture, std::size_t rung, double seconds) {
  if (rungs_of(picture) > 1) {
    rungs_->see(last_time_, rung, seconds);
  }
}

void VrWorld::place(double time, const HeadAndViews& now, std::optional<tracking::GazeSample> sample) {
  if (replay_) {
    replay_place(now);
    return;
  }
  if (sample && sample->time) {
    *sample->time += session_from_runtime_;
  }
  const HeadAndViews where = steadied(now, wearer_.views());
  show(shown_.picture());
  const auto& target = shown_.target();
  wearer_.step(time, where, sample, target ? std::optional(scene_.targets[*target].position) : std::nullopt);
  watch_prism(time);
  if (views_apart_ && picture_.pairs != warned_of_) {
    find_warnings();
  }
  if (recorder_) {
    recorder_->frame(trace_row(time, where, wearer_, sample && sample->valid), recorded_views(where), rung_name(),
                     pair_name(), recorded_picture(picture_));
  }
  const bool at_target = wearer_.source() == tracking::GazeSource::target;
  count_picture(gaze_source() + (at_target ? " " + target_name() : ""));
}

void VrWorld::watch_reprojection(double time, const HeadAndViews& where, double period) {
  if (replay_) {
    return;  // that head was another day's
  }
  reprojection_.see(time, where.world_from_head);
  if (!reprojection_.is_known()) {
    return;
  }
  const double error = reprojection_.error(setup().lenses, setup().pairs, wearer_.state().gaze, period);
  report_.head_speed.add(glm::degrees(glm::length(reprojection_.head_turn())));
  report_.reprojection_error.add(glm::degrees(error) * 60.0);
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
  if (const std::string map = map_name(); !map.empty()) {
    return pair_name() + ", " + map + " map";
  }
  return pair_name() + (picture_.mode == shown_.base() ? "" : ", clear view");
}

std::string VrWorld::map_name() const {
  return render::is_map(picture_.mode) ? mode_names()[static_cast<std::size_t>(picture_.mode)] : "";
}

std::string VrWorld::target_name() const {
  return shown_.target() ? scene_.targets[*shown_.target()].name : "";
}

void VrWorld::warn(double views_apart) {
  views_apart_ = views_apart;
  find_warnings();
}

void VrWorld::find_warnings() {
  const RenderSetup& setup = wearer_.setup();
  warned_of_ = picture_.pairs;
  warnings_ = viewer_report(setup);
  std::erase_if(warnings_, [](const ViewerFinding& found) { return found.finding.code == kPrism; });  // watched live
  std::array<double, 2> power{};
  for (const std::size_t i : {0U, 1U}) {
    power[i] = horizontal_power(lenses::f64::Table{setup.lenses.table}, setup.pairs.front().eyes[i]);
  }
  if (const auto finding = lenses::distance_finding(setup.wearer, *views_apart_, power)) {
    warnings_.push_back({"", *finding});
  }
  name_pair(warnings_);
  tell(warnings_);
}

void VrWorld::watch_prism(double time) {
  std::vector<ViewerFinding> found = prism_findings(setup());
  name_pair(found);
  tell(prism_.see(time, found));
}

std::vector<ViewerFinding> VrWorld::warnings() const {
  std::vector<ViewerFinding> now = warnings_;
  now.insert(now.end(), prism_.current().begin(), prism_.current().end());
  return now;
}

// The pair that the session was started with needs no name.
void VrWorld::name_pair(std::vector<ViewerFinding>& findings) const {
  for (ViewerFinding& found : findings) {
    const bool of_pair = found.finding.code == kPrism || found.finding.code == "pupillary_distance";
    if (of_pair && found.pair.empty() && picture_.pairs != started_with_) {
      found.pair = setup().pairs.front().name;
    }
  }
}

// Into the report once. A prism changes with every glance: the first that is found stands for its pair.
void VrWorld::tell(const std::vector<ViewerFinding>& findings) {
  std::vector<ViewerFinding> news;
  for (const ViewerFinding& found : findings) {
    const auto is_same = [&](const ViewerFinding& told) {
      return told.pair == found.pair && told.finding.code == found.finding.code &&
             (found.finding.code == kPrism || told.finding.message == found.finding.message);
    };
    if (std::ranges::none_of(report_.findings, is_same)) {
      news.push_back(found);
    }
  }
  report_.findings.insert(report_.findings.end(), news.begin(), news.end());
  std::cerr << to_table(news);
}

}  // namespace app
