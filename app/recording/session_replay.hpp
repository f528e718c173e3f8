// A recorded session, or any pose and gaze trace, read to be shown again.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "app/recording/session_record.hpp"
#include "tracking/gaze_trace.hpp"

namespace app {

class SessionReplay {
 public:
  // Reads FILE.csv and, where there is one, FILE.csv.json. Throws tracking::InputError.
  explicit SessionReplay(const std::string& trace_file);
  // From text in memory; an empty record stands for none.
  SessionReplay(tracking::GazeTrace trace, std::optional<SessionRecord> record, const std::string& file);

  [[nodiscard]] std::size_t frames() const { return trace_.rows.size(); }
  [[nodiscard]] bool last_line_cut() const { return trace_.last_line_cut; }
  [[nodiscard]] const std::string& file() const { return file_; }  // the record's
  [[nodiscard]] const std::optional<SessionRecord>& record() const { return record_; }

  // Of one frame. What a trace without a record does not say is null.
  struct Frame {
    const tracking::TraceRow* row;
    const std::array<RecordedView, 2>* views;  // indexed by Side
    const std::string* rung;
    const std::string* pair;
    const ShownChange* shown;
  };
  [[nodiscard]] Frame frame(std::size_t index) const;  // index < frames()

  // The events recorded just before a frame.
  [[nodiscard]] std::vector<RecordedEvent> events_before(std::size_t index) const;

 private:
  tracking::GazeTrace trace_;
  std::optional<SessionRecord> record_;
  std::string file_;
};

}  // namespace app
