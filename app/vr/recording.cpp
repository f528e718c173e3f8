#include "app/vr/recording.hpp"

namespace app {

using tracking::Side;

std::array<RecordedView, 2> recorded_views(const HeadAndViews& where) {
  return {RecordedView{where.eyes[0].head_from_view, where.eyes[0].fov},
          RecordedView{where.eyes[1].head_from_view, where.eyes[1].fov}};
}

tracking::TraceRow trace_row(double time, const HeadAndViews& where, const LiveWearer& wearer, bool gaze_valid) {
  const tracking::EyeState& state = wearer.state();
  return {.time = time,
          .head = where.world_from_head,
          .gaze = state.gaze,
          .gaze_valid = gaze_valid,
          .eyes = tracking::EyesInFrame{state.pupil_diameter, state.accommodation},
          .source = state.source};
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
  if (row.eyes && frame.views != nullptr) {
    wearer.place(where, row.gaze, *row.eyes);
    return;
  }
  tracking::GazeSample sample{.time = row.time, .eye = {}, .combined = {}, .valid = row.gaze_valid};
  for (const Side side : {Side::right, Side::left}) {
    sample.eye[static_cast<std::size_t>(side)] = row.gaze[static_cast<std::size_t>(side)];
  }
  wearer.step(row.time, where, sample);
}

}  // namespace app
