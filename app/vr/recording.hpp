// --record and --replay of `vergence vr`: what a frame was drawn from, kept and drawn again.
#pragma once

#include <optional>
#include <string>

#include "app/recording/session_recorder.hpp"
#include "app/recording/session_replay.hpp"
#include "app/vr/live_wearer.hpp"

namespace app {

[[nodiscard]] std::array<RecordedView, 2> recorded_views(const HeadAndViews& where);

// The row of a frame as the wearer was drawn in it.
[[nodiscard]] tracking::TraceRow trace_row(double time, const HeadAndViews& where, const LiveWearer& wearer,
                                           bool gaze_valid);

// Draws the wearer from a recorded frame. A plain trace says less than a recording: what it does not say of the views
// is taken from `now`, and eyes that it does not have follow the gaze in time.
void replay_frame(LiveWearer& wearer, const SessionReplay::Frame& frame, const HeadAndViews& now);

}  // namespace app
