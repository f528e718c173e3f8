#include "xr/layer/recorded_gaze.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace xr::layer {
namespace {

using tracking::TraceRow;

constexpr double kNanoseconds = 1e9;

// The last row stays as long as the rows before it did on average.
double loop_period(const std::vector<TraceRow>& rows) {
  const double span = rows.back().time - rows.front().time;
  return rows.size() < 2 ? 0.0 : span + span / static_cast<double>(rows.size() - 1);
}

}  // namespace

RecordedGaze::RecordedGaze(tracking::GazeTrace trace, AtEnd at_end)
    : rows_(std::move(trace.rows)), at_end_(at_end), period_(loop_period(rows_)) {}

GazeReading RecordedGaze::at(XrTime time, XrTime start) const {
  const double elapsed = static_cast<double>(std::max<XrTime>(time - start, 0)) / kNanoseconds;
  const double span = rows_.back().time - rows_.front().time;
  double played = elapsed;
  if (at_end_ == AtEnd::loop && period_ > 0.0) {
    played = std::fmod(elapsed, period_);
  }
  // A time written as a decimal and one counted in nanoseconds differ by rounding; half a nanosecond belongs to
  // neither.
  const double now = rows_.front().time + played + 0.5 / kNanoseconds;
  const auto after =
      std::upper_bound(rows_.begin(), rows_.end(), now, [](double t, const TraceRow& row) { return t < row.time; });
  const TraceRow& row = after == rows_.begin() ? rows_.front() : *std::prev(after);

  const bool held = at_end_ == AtEnd::hold && elapsed > span;
  const bool stopped = at_end_ == AtEnd::stop && elapsed > period_;
  const double age = held ? 0.0 : std::max(now - row.time, 0.0);
  GazeReading reading{.valid = row.gaze_valid && !stopped, .direction = row.gaze};
  reading.sample_time = time - static_cast<XrTime>(age * kNanoseconds);
  return reading;
}

}  // namespace xr::layer
