#include "app/recording/session_replay.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "lenses/lens_io/json_document.hpp"
#include "tracking/input_error.hpp"

namespace app {
namespace {

using tracking::InputError;

// Null before the first change, and where there is none.
template <class Change>
const Change* at(const std::vector<Change>& changes, std::size_t frame) {
  const auto after = std::ranges::upper_bound(changes, frame, {}, &Change::frame);
  return after == changes.begin() ? nullptr : &*std::prev(after);
}

// A crash may have come between a change and the frame it was for.
template <class Change>
void check(const std::vector<Change>& changes, const char* list, std::size_t frames, bool from_start,
           const std::string& file) {
  if (changes.empty()) {
    return;
  }
  if (from_start && changes.front().frame != 0) {
    throw InputError(file, std::string(list) + "[0].frame",
                     "is " + std::to_string(changes.front().frame) + "; the first entry must be of frame 0");
  }
  if (changes.back().frame > frames) {
    throw InputError(file, std::string(list) + "[" + std::to_string(changes.size() - 1) + "].frame",
                     "is " + std::to_string(changes.back().frame) + ", but the trace has only " +
                         std::to_string(frames) + " frames");
  }
}

std::optional<SessionRecord> read_record(const std::string& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) {
    return std::nullopt;
  }
  return parse_session_record(lenses::io::read_text_file(file), file);
}

}  // namespace

SessionReplay::SessionReplay(const std::string& trace_file)
    : SessionReplay(tracking::read_gaze_trace(trace_file), read_record(record_file(trace_file)),
                    record_file(trace_file)) {}

SessionReplay::SessionReplay(tracking::GazeTrace trace, std::optional<SessionRecord> record, const std::string& file)
    : trace_(std::move(trace)), record_(std::move(record)), file_(file) {
  if (record_) {
    check(record_->views, "views", frames(), true, file);
    check(record_->rungs, "rungs", frames(), true, file);
    check(record_->pairs, "pairs", frames(), true, file);
    check(record_->shown, "shown", frames(), true, file);
    check(record_->events, "events", frames(), false, file);
  }
}

SessionReplay::Frame SessionReplay::frame(std::size_t index) const {
  Frame frame{&trace_.rows.at(index), nullptr, nullptr, nullptr, nullptr};
  if (record_) {
    const ViewChange* views = at(record_->views, index);
    const NameChange* rung = at(record_->rungs, index);
    const NameChange* pair = at(record_->pairs, index);
    frame.views = views != nullptr ? &views->view : nullptr;
    frame.rung = rung != nullptr ? &rung->name : nullptr;
    frame.pair = pair != nullptr ? &pair->name : nullptr;
    frame.shown = at(record_->shown, index);
  }
  return frame;
}

std::vector<RecordedEvent> SessionReplay::events_before(std::size_t index) const {
  if (!record_) {
    return {};
  }
  const auto begin = std::ranges::lower_bound(record_->events, index, {}, &RecordedEvent::frame);
  const auto end = std::ranges::upper_bound(record_->events, index, {}, &RecordedEvent::frame);
  return {begin, end};
}

}  // namespace app
