// What belongs to a recorded session beside its trace: FILE.csv.json. Poses and gaze are in FILE.csv, a line a frame;
// what stays for many frames is here, as the frames at which it changed.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tracking/stereo_view.hpp"

namespace app {

struct RecordedView {
  tracking::Pose head_from_view;
  tracking::FieldOfView fov;
};

// From a frame on, counted in the trace's rows.
struct ViewChange {
  std::size_t frame = 0;
  std::array<RecordedView, 2> view;  // indexed by Side
};
struct NameChange {
  std::size_t frame = 0;
  std::string name;
};

// What is in view from a frame on: one pair or A and B, counted as the command's options name them (--spectacles 0,
// then
// --pairs, --compare and at last the eyes without), and --mode's name for what is drawn.
struct ShownChange {
  std::size_t frame = 0;
  std::vector<std::size_t> pairs;
  std::string picture;
};

struct RecordedEvent {
  std::size_t frame = 0;  // the first one after it
  double time = 0.0;      // s, in the trace's clock
  std::string what;       // a control's name ("next_pair"), "recentred", "session lost"
};

struct SessionRecord {
  std::string device;                                        // the GPU's name
  std::array<int, 2> size{};                                 // of each view, pixels
  std::vector<std::pair<std::string, std::string>> options;  // as the command line gave them, without the dashes
  std::vector<ViewChange> views;                             // each list in the order of its frames
  std::vector<NameChange> rungs, pairs;
  std::vector<RecordedEvent> events;
  std::vector<ShownChange> shown = {};
};

[[nodiscard]] std::string record_file(const std::string& trace_file);  // FILE.csv.json

// Numbers are the shortest text that reads back as the same double.
[[nodiscard]] std::string to_json(const SessionRecord& record);
// Strict: a tracking::InputError with the field's path and what is allowed.
[[nodiscard]] SessionRecord parse_session_record(std::string_view text, const std::string& file);

}  // namespace app
