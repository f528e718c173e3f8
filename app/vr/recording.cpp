#include "app/vr/recording.hpp"

#include <algorithm>
#include <string>

#include "app/mode_option.hpp"
#include "tracking/input_error.hpp"

namespace app {

using tracking::Side;

std::array<RecordedView, 2> recorded_views(const HeadAndViews& where) {
  return {RecordedView{where.eyes[0].head_from_view, where.eyes[0].fov},
          RecordedView{where.eyes[1].head_from_view, where.eyes[1].fov}};
}

tracking::TraceRow trace_row(double time, const HeadAndViews& where, const LiveWearer& wearer, bool gaze_valid) {
  const tracking::EyeState& state = wearer.state();
  tracking::TraceRow row{.time = time,
                         .head = where.world_from_head,
                         .gaze = state.gaze,
                         .gaze_valid = gaze_valid,
                         .eyes = tracking::EyesInFrame{state.pupil_diameter, state.accommodation},
                         .source = wearer.source()};
  if (wearer.setup().pairs.size() > 1) {
    const tracking::EyeState& second = wearer.state(1);
    row.second = tracking::EyesBehindSecond{second.gaze, second.accommodation};
  }
  return row;
}

ShownChange recorded_picture(const ShownPicture& picture) {
  return {0, picture.pairs, mode_names()[static_cast<std::size_t>(picture.mode)]};
}

void check_pictures(const SessionReplay& replay, std::size_t pairs) {
  if (!replay.record()) {
    return;
  }
  const auto refuse = [&](std::size_t at, const std::string& field, const std::string& reason) {
    throw tracking::InputError(replay.file(), "shown[" + std::to_string(at) + "]." + field, reason);
  };
  const std::vector<ShownChange>& changes = replay.record()->shown;
  for (std::size_t at = 0; at < changes.size(); ++at) {
    if (std::ranges::find(mode_names(), changes[at].picture) == mode_names().end()) {
      refuse(at, "picture", "'" + changes[at].picture + "' is none of --mode's names");
    }
    for (std::size_t i = 0; i < changes[at].pairs.size(); ++i) {
      if (changes[at].pairs[i] >= pairs) {
        refuse(at, "pairs[" + std::to_string(i) + "]",
               "is " + std::to_string(changes[at].pairs[i]) + ", but the options name pairs 0 to " +
                   std::to_string(pairs - 1) + "; give --spectacles, --pairs and --compare as they were recorded");
      }
    }
  }
}

std::optional<ShownPicture> replayed_picture(const SessionReplay::Frame& frame) {
  if (frame.shown == nullptr) {
    return std::nullopt;
  }
  return ShownPicture{frame.shown->pairs, mode_of(frame.shown->picture)};
}

void replay_frame(LiveWearer& wearer, const SessionReplay::Frame& frame, const HeadAndViews& now) {
  const tracking::TraceRow& row = *frame.row;
  HeadAndViews where = now;
  where.world_from_head = row.head;
  if (frame.views != nullptr) {
    for (const std::size_t i : {0U, 1U}) {
      where.eyes[i].head_from_view = (*frame.views)[i].head_from_view;
      where.eyes[i].fov = (*frame.views)[i].fov;
    }
  }
  const bool two = wearer.setup().pairs.size() > 1;
  if (row.eyes && frame.views != nullptr && (!two || row.second)) {
    std::vector<EyesDrawn> eyes{{row.gaze, *row.eyes}};
    if (two) {
      // The light is the same, and so are the pupils.
      eyes.push_back({row.second->gaze, {row.eyes->pupil_diameter, row.second->accommodation}});
    }
    wearer.place(where, eyes);
    return;
  }
  tracking::GazeSample sample{.time = row.time, .eye = {}, .combined = {}, .valid = row.gaze_valid};
  for (const Side side : {Side::right, Side::left}) {
    sample.eye[static_cast<std::size_t>(side)] = row.gaze[static_cast<std::size_t>(side)];
  }
  wearer.step(row.time, where, sample);
}

}  // namespace app
