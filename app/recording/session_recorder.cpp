#include "app/recording/session_recorder.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "render/image/output_file.hpp"

namespace app {
namespace {

bool same(const RecordedView& a, const RecordedView& b) {
  const tracking::FieldOfView &f = a.fov, &g = b.fov;
  return a.head_from_view.position == b.head_from_view.position &&
         a.head_from_view.orientation == b.head_from_view.orientation && f.tan_left == g.tan_left &&
         f.tan_right == g.tan_right && f.tan_down == g.tan_down && f.tan_up == g.tan_up;
}

// Of a change within a frame only the last counts.
template <class Change>
void add(std::vector<Change>& changes, Change change) {
  if (!changes.empty() && changes.back().frame == change.frame) {
    changes.pop_back();
  }
  changes.push_back(std::move(change));
}

bool add_name(std::vector<NameChange>& changes, std::size_t frame, const std::string& name) {
  if (!changes.empty() && changes.back().name == name) {
    return false;
  }
  add(changes, {frame, name});
  return true;
}

}  // namespace

SessionRecorder::SessionRecorder(const std::string& trace_file, SessionRecord start)
    : file_(record_file(trace_file)), record_(std::move(start)), writer_(trace_file, {.second = true}) {
  save();
}

void SessionRecorder::save() const {
  const std::string text = to_json(record_);
  render::write_file(file_, std::as_bytes(std::span(text)));
}

bool SessionRecorder::frame(const tracking::TraceRow& row, const std::array<RecordedView, 2>& views,
                            const std::string& rung, const std::string& pair, const std::optional<ShownChange>& shown) {
  const std::size_t index = writer_.rows();
  bool changed = false;
  if (record_.views.empty() || !same(record_.views.back().view[0], views[0]) ||
      !same(record_.views.back().view[1], views[1])) {
    add(record_.views, {index, views});
    changed = true;
  }
  changed = add_name(record_.rungs, index, rung) || changed;
  changed = add_name(record_.pairs, index, pair) || changed;
  if (shown && (record_.shown.empty() || record_.shown.back().pairs != shown->pairs ||
                record_.shown.back().picture != shown->picture)) {
    add(record_.shown, {index, shown->pairs, shown->picture});
    changed = true;
  }
  if (changed) {
    save();
  }
  return writer_.write(row);
}

void SessionRecorder::event(double time, const std::string& what) {
  record_.events.push_back({writer_.rows(), time, what});
  save();
}

}  // namespace app
