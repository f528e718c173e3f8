// Records a session frame by frame into FILE.csv and FILE.csv.json. A crash of the program loses nothing that was
// recorded: each line is with the system before the next frame, the JSON file is replaced whole, and before the first
// line that needs it.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "app/recording/session_record.hpp"
#include "tracking/gaze_trace.hpp"

namespace app {

class SessionRecorder {
 public:
  // start: device, size and options of the session. Replaces both files. Throws std::runtime_error where they cannot be
  // written, as do the calls below.
  SessionRecorder(const std::string& trace_file, SessionRecord start);

  // What was drawn: a frame with its views (indexed by Side), its rung, the pair worn and what was in view (its frame
  // does not count; nothing: not known). False where the row cannot be recorded (see GazeTraceWriter::write).
  bool frame(const tracking::TraceRow& row, const std::array<RecordedView, 2>& views, const std::string& rung,
             const std::string& pair, const std::optional<ShownChange>& shown = std::nullopt);

  // Something that happened before the frame to come.
  void event(double time, const std::string& what);

  [[nodiscard]] std::size_t frames() const { return writer_.rows(); }

 private:
  void save() const;

  std::string file_;
  SessionRecord record_;
  tracking::GazeTraceWriter writer_;
};

}  // namespace app
