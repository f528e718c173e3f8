// --record and --replay of `vergence vr`: what a frame was drawn from, kept and drawn again.
#pragma once

#include <array>
#include <optional>

#include "app/recording/session_recorder.hpp"
#include "app/recording/session_replay.hpp"
#include "app/vr/live_wearer.hpp"
#include "app/vr/shown.hpp"

namespace app {

[[nodiscard]] std::array<RecordedView, 2> recorded_views(const HeadAndViews& where);

// The row of a frame as the wearer was drawn in it.
[[nodiscard]] tracking::TraceRow trace_row(double time, const HeadAndViews& where, const LiveWearer& wearer,
                                           bool gaze_valid);

[[nodiscard]] ShownChange recorded_picture(const ShownPicture& picture);

// Throws tracking::InputError, naming the recording's field, for pictures that this session cannot show: pairs beyond
// `pairs`, modes that there are not.
void check_pictures(const SessionReplay& replay, std::size_t pairs);

// What is in view in a recorded frame; nothing: the recording does not say.
[[nodiscard]] std::optional<ShownPicture> replayed_picture(const SessionReplay::Frame& frame);

// Draws the wearer, who wears what the frame shows, from a recorded frame. A plain trace says less than a recording:
// what it does not say of the views is taken from `now`, and eyes that it does not have follow the gaze in time.
void replay_frame(LiveWearer& wearer, const SessionReplay::Frame& frame, const HeadAndViews& now);

}  // namespace app
