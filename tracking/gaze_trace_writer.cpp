#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <glm/gtc/quaternion.hpp>
#include <stdexcept>

#include "tracking/direction.hpp"
#include "tracking/gaze_trace.hpp"
#include "tracking/gaze_trace_columns.hpp"

namespace tracking {
namespace {

// The shortest text that reads back as the same double.
void append(std::string& line, double value) {
  char text[32];
  const auto end = std::to_chars(std::begin(text), std::end(text), value).ptr;
  if (!line.empty()) line += ',';
  line.append(std::begin(text), end);
}

void append(std::string& line, const glm::dvec3& v) {
  append(line, v.x);
  append(line, v.y);
  append(line, v.z);
}

bool is_finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool within(double value, double most) {
  return value >= 0.0 && value <= most;
}

bool readable(const TraceRow& row) {
  const glm::dvec3& p = row.head.position;
  bool good = std::isfinite(row.time) && row.head.is_finite() &&
              std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) <= kFarthestHead &&
              std::abs(glm::length(row.head.orientation) - 1.0) < kUnitRoughly;
  for (const glm::dvec3& gaze : row.gaze) {
    good = good && is_finite(gaze) && (!row.gaze_valid || unit_direction(gaze));
  }
  for (std::size_t i = 0; row.eyes && i < 2; ++i) {
    good = good && within(row.eyes->pupil_diameter[i], kLargestPupil) &&
           within(row.eyes->accommodation[i], kMostAccommodation);
  }
  for (std::size_t i = 0; row.second && i < 2; ++i) {
    good = good && is_finite(row.second->gaze[i]) && unit_direction(row.second->gaze[i]) &&
           within(row.second->accommodation[i], kMostAccommodation);
  }
  return good;
}

std::string header_of(const GazeTraceWriter::Columns& columns) {
  std::string line;
  const auto add = [&](std::string_view name) {
    if (!line.empty()) line += ',';
    line += name;
  };
  for (const std::string_view name : kTraceColumns) add(name);
  for (const std::string_view name : kEyeColumns) {
    if (columns.eyes) add(name);
  }
  if (columns.source) add(kSourceColumn);
  for (const std::string_view name : kSecondColumns) {
    if (columns.second) add(name);
  }
  return line;
}

}  // namespace

GazeTraceWriter::GazeTraceWriter(const std::string& path, const Columns& columns)
    : path_(path), columns_(columns), file_(std::fopen(path.c_str(), "wb")) {
  if (!file_) {
    throw std::runtime_error(path + ": cannot be written: " + std::strerror(errno));
  }
  put(header_of(columns));
}

void GazeTraceWriter::put(const std::string& line) {
  const std::string text = line + "\n";
  if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size() || std::fflush(file_.get()) != 0) {
    throw std::runtime_error(path_ + ": cannot be written: " + std::strerror(errno));
  }
}

bool GazeTraceWriter::write(const TraceRow& row) {
  if (!readable(row) || (last_time_ && !(row.time > *last_time_))) {
    return false;
  }
  std::string line;
  append(line, row.time);
  append(line, row.head.position);
  const glm::dquat& q = row.head.orientation;
  append(line, {q.x, q.y, q.z});
  append(line, q.w);
  append(line, row.gaze[static_cast<std::size_t>(Side::left)]);
  append(line, row.gaze[static_cast<std::size_t>(Side::right)]);
  line += row.gaze_valid ? ",1" : ",0";
  if (columns_.eyes) {
    const EyesInFrame eyes = row.eyes.value_or(EyesInFrame{});
    for (const auto& pair : {eyes.pupil_diameter, eyes.accommodation}) {
      append(line, pair[static_cast<std::size_t>(Side::left)]);
      append(line, pair[static_cast<std::size_t>(Side::right)]);
    }
  }
  if (columns_.source) {
    line += ',';
    line += name(row.source.value_or(row.gaze_valid ? GazeSource::tracker : GazeSource::held));
  }
  if (columns_.second) {
    const EyesBehindSecond second = row.second.value_or(EyesBehindSecond{});
    for (const Side side : {Side::left, Side::right}) append(line, second.gaze[static_cast<std::size_t>(side)]);
    for (const Side side : {Side::left, Side::right})
      append(line, second.accommodation[static_cast<std::size_t>(side)]);
  }
  put(line);
  last_time_ = row.time;
  ++rows_;
  return true;
}

}  // namespace tracking
