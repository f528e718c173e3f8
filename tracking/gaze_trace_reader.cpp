#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <system_error>

#include "tracking/direction.hpp"
#include "tracking/gaze_trace.hpp"
#include "tracking/gaze_trace_columns.hpp"
#include "tracking/input_error.hpp"

namespace tracking {
namespace {

constexpr std::size_t kMostRows = 4'000'000;  // 12 hours at 90 Hz
constexpr std::size_t kLongestLine = 8192;
constexpr std::size_t kMostColumns = 256;
constexpr std::size_t kFirst = kTraceColumns.size();

std::string_view trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

// For messages: printable, short, in quotes.
std::string quoted(std::string_view text) {
  std::string out = "'";
  for (const char c : text.substr(0, 40)) {
    out += c >= ' ' && c <= '~' ? c : '?';
  }
  return out + (text.size() > 40 ? "...'" : "'");
}

// Fields between commas; a comma within double quotes separates nothing.
void split(std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  bool within = false;
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    if (i < line.size() && line[i] == '"') {
      within = !within;
    }
    if (i == line.size() || (line[i] == ',' && !within)) {
      fields.push_back(trimmed(line.substr(begin, i - begin)));
      begin = i + 1;
    }
  }
}

std::string header_text() {
  std::string text;
  for (const std::string_view name : kTraceColumns) {
    if (!text.empty()) text += ',';
    text += name;
  }
  return text;
}

// Takes a trace line by line.
class Parser {
 public:
  explicit Parser(const std::string& file) : file_(file) {}

  // `whole`: the line had an end.
  void take(std::string_view line, bool whole) {
    ++number_;
    if (number_ == 1 && line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.size() > kLongestLine) {
      fail("", "is longer than " + std::to_string(kLongestLine) + " characters; a line a frame is expected");
    }
    if (number_ == 1) {
      read_header(line);
    } else if (!trimmed(line).empty()) {
      take_row(line, whole);
    }
  }

  GazeTrace finish() {
    if (number_ == 0) {
      throw InputError(file_, "", "is empty; the header must begin with " + header_text());
    }
    if (trace_.rows.empty()) {
      throw InputError(file_, "", "has no rows; at least one frame is needed");
    }
    return std::move(trace_);
  }

 private:
  [[noreturn]] void fail(std::string_view column, const std::string& reason) const {
    std::string place = "line " + std::to_string(number_);
    if (!column.empty()) place.append(": ").append(column);
    throw InputError(file_, place, reason);
  }

  void read_header(std::string_view line) {
    split(line, fields_);
    if (fields_.size() < kFirst || !std::equal(kTraceColumns.begin(), kTraceColumns.end(), fields_.begin())) {
      const auto differs = std::ranges::mismatch(kTraceColumns, fields_);
      const std::string there = differs.in2 == fields_.end() ? "ends" : "has " + quoted(*differs.in2);
      fail("", "is no header of a trace: it " + there + " where " + std::string(*differs.in1) +
                   " is expected; it must begin with " + header_text());
    }
    if (fields_.size() > kMostColumns) {
      fail("", "has " + std::to_string(fields_.size()) + " columns; at most " + std::to_string(kMostColumns) +
                   " are allowed");
    }
    columns_ = fields_.size();
    for (std::size_t i = 0; i < kEyeColumns.size(); ++i) {
      eye_column_[i] = find_further(kEyeColumns[i]);
    }
    source_column_ = find_further(kSourceColumn);
    const auto there = std::ranges::count_if(eye_column_, [](std::size_t c) { return c != 0; });
    if (there != 0 && there != 4) {
      fail("",
           "has some of left_pupil_m, right_pupil_m, left_accommodation_D, right_accommodation_D; all four or none "
           "are allowed");
    }
    for (std::size_t i = 0; i < kSecondColumns.size(); ++i) {
      second_column_[i] = find_further(kSecondColumns[i]);
    }
    const auto of_second = std::ranges::count_if(second_column_, [](std::size_t c) { return c != 0; });
    if (of_second != 0 && of_second != std::ssize(kSecondColumns)) {
      fail("", "has some of the columns b_left_gx to b_right_accommodation_D; all eight or none are allowed");
    }
    for (std::size_t i = kFirst; i < fields_.size(); ++i) {
      if (std::ranges::find(kTraceColumns, fields_[i]) != kTraceColumns.end()) {
        fail(fields_[i], "is given twice; a column may appear once");
      }
    }
  }

  // 0: not there.
  [[nodiscard]] std::size_t find_further(std::string_view name) const {
    const auto begin = fields_.begin() + static_cast<std::ptrdiff_t>(kFirst);
    const auto found = std::find(begin, fields_.end(), name);
    if (found == fields_.end()) {
      return 0;
    }
    if (std::find(found + 1, fields_.end(), name) != fields_.end()) {
      fail(name, "is given twice; a column may appear once");
    }
    return static_cast<std::size_t>(found - fields_.begin());
  }

  void take_row(std::string_view line, bool whole) {
    split(line, fields_);
    if (!whole && fields_.size() < columns_) {
      trace_.last_line_cut = true;
      return;
    }
    if (fields_.size() != columns_) {
      fail("", "has " + std::to_string(fields_.size()) + " fields; the header names " + std::to_string(columns_));
    }
    if (trace_.rows.size() >= kMostRows) {
      fail("", "is one row too many; at most " + std::to_string(kMostRows) + " are read");
    }
    trace_.rows.push_back(row());
  }

  [[nodiscard]] TraceRow row() const {
    TraceRow row;
    row.time = number(0);
    if (!trace_.rows.empty() && !(row.time > trace_.rows.back().time)) {
      fail(kTraceColumns[0], "is " + quoted(fields_[0]) + ", not later than the row before; times must increase");
    }
    row.head.position = {number(1, -kFarthestHead, kFarthestHead), number(2, -kFarthestHead, kFarthestHead),
                         number(3, -kFarthestHead, kFarthestHead)};
    row.head.orientation = orientation();
    row.gaze_valid = valid();
    row.gaze[static_cast<std::size_t>(Side::left)] = direction(8, row.gaze_valid);
    row.gaze[static_cast<std::size_t>(Side::right)] = direction(11, row.gaze_valid);
    if (eye_column_[0] != 0) {
      row.eyes = eyes();
    }
    if (source_column_ != 0) {
      row.source = source();
    }
    if (second_column_[0] != 0) {
      row.second = second();
    }
    return row;
  }

  [[nodiscard]] std::string column_name(std::size_t column) const {
    if (column < kFirst) return std::string(kTraceColumns[column]);
    if (const auto eye = std::ranges::find(eye_column_, column); eye != eye_column_.end()) {
      return std::string(kEyeColumns[static_cast<std::size_t>(eye - eye_column_.begin())]);
    }
    const auto second = std::ranges::find(second_column_, column);
    return std::string(second == second_column_.end()
                           ? kSourceColumn
                           : kSecondColumns[static_cast<std::size_t>(second - second_column_.begin())]);
  }

  [[nodiscard]] double number(std::size_t column) const {
    const std::string_view text = fields_[column];
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (text.empty() || end != text.data() + text.size() || error == std::errc::invalid_argument) {
      fail(column_name(column), text.empty() ? "is empty; a number is needed" : quoted(text) + " is not a number");
    }
    if (error != std::errc{} || !std::isfinite(value)) {
      fail(column_name(column), quoted(text) + " is not finite in double precision; a finite number is needed");
    }
    return value;
  }

  [[nodiscard]] double number(std::size_t column, double low, double high) const {
    const double value = number(column);
    if (!(value >= low && value <= high)) {
      char limits[64];
      static_cast<void>(std::snprintf(limits, sizeof limits, "from %g to %g", low, high));
      fail(column_name(column), quoted(fields_[column]) + " is out of range; " + limits);
    }
    return value;
  }

  [[nodiscard]] glm::dquat orientation() const {
    const glm::dquat q(number(7, -2.0, 2.0), number(4, -2.0, 2.0), number(5, -2.0, 2.0), number(6, -2.0, 2.0));
    const double off = std::abs(glm::length(q) - 1.0);
    if (off > kUnitRoughly) {
      char length[64];
      static_cast<void>(std::snprintf(length, sizeof length, "%.6g", glm::length(q)));
      fail("head_qx", std::string("head_qx, head_qy, head_qz, head_qw have the length ") + length +
                          "; a unit quaternion is needed, to within 0.001");
    }
    return off > kUnitExactly ? glm::normalize(q) : q;
  }

  [[nodiscard]] bool valid() const {
    const std::string_view text = fields_[14];
    if (text != "0" && text != "1") {
      fail(kTraceColumns[14], quoted(text) + " is not allowed; 0 or 1");
    }
    return text == "1";
  }

  [[nodiscard]] glm::dvec3 direction(std::size_t column, bool is_valid) const {
    const glm::dvec3 d(number(column), number(column + 1), number(column + 2));
    const auto unit = unit_direction(d);
    if (!unit) {
      if (!is_valid) return d;
      fail(column_name(column), "the gaze direction is 0; with gaze_valid 1 it must point somewhere");
    }
    return std::abs(glm::length(d) - 1.0) > kUnitExactly ? *unit : d;
  }

  [[nodiscard]] EyesInFrame eyes() const {
    EyesInFrame eyes;
    for (const Side side : {Side::left, Side::right}) {
      const std::size_t i = side == Side::left ? 0 : 1;
      eyes.pupil_diameter[static_cast<std::size_t>(side)] = number(eye_column_[i], 0.0, kLargestPupil);
      eyes.accommodation[static_cast<std::size_t>(side)] = number(eye_column_[i + 2], 0.0, kMostAccommodation);
    }
    return eyes;
  }

  [[nodiscard]] GazeSource source() const {
    for (const GazeSource source : kGazeSources) {
      if (fields_[source_column_] == name(source)) return source;
    }
    fail(kSourceColumn, quoted(fields_[source_column_]) + " is not allowed; target, tracker, held or head");
  }

  // Nothing where all are 0: no second pair was worn then.
  [[nodiscard]] std::optional<EyesBehindSecond> second() const {
    const auto& column = second_column_;
    if (std::ranges::all_of(column, [&](std::size_t c) { return number(c) == 0.0; })) {
      return std::nullopt;
    }
    EyesBehindSecond eyes;
    for (const Side side : {Side::left, Side::right}) {
      const auto i = static_cast<std::size_t>(side);
      const std::size_t at = side == Side::left ? 0 : 1;
      const glm::dvec3 gaze(number(column[3 * at]), number(column[3 * at + 1]), number(column[3 * at + 2]));
      const auto unit = unit_direction(gaze);
      if (!unit) {
        fail(kSecondColumns[3 * at], "the gaze direction is 0; it must point somewhere, or all of b_... be 0");
      }
      eyes.gaze[i] = std::abs(glm::length(gaze) - 1.0) > kUnitExactly ? *unit : gaze;
      eyes.accommodation[i] = number(column[6 + at], 0.0, kMostAccommodation);
    }
    return eyes;
  }

  const std::string& file_;
  std::size_t number_ = 0, columns_ = 0;
  std::array<std::size_t, 4> eye_column_{};
  std::size_t source_column_ = 0;
  std::array<std::size_t, 8> second_column_{};
  std::vector<std::string_view> fields_;
  GazeTrace trace_;
};

// Feeds all whole lines and returns the rest.
std::string_view feed(Parser& parser, std::string_view text) {
  for (std::size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n')) {
    parser.take(text.substr(0, end), true);
    text.remove_prefix(end + 1);
  }
  return text;
}

}  // namespace

GazeTrace parse_gaze_trace(std::string_view text, const std::string& file) {
  Parser parser(file);
  const std::string_view rest = feed(parser, text);
  if (!rest.empty()) {
    parser.take(rest, false);
  }
  return parser.finish();
}

GazeTrace read_gaze_trace(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    throw InputError(path, "", "cannot be read: it is a folder; a file is needed");
  }
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    throw InputError(path, "",
                     "cannot be read: " +
                         (errno != 0 ? std::generic_category().message(errno) : std::string("it cannot be opened")));
  }
  Parser parser(path);
  std::vector<char> chunk(std::size_t{1} << 16);
  std::string pending;
  while (stream.read(chunk.data(), static_cast<std::streamsize>(chunk.size())) || stream.gcount() > 0) {
    pending.append(chunk.data(), static_cast<std::size_t>(stream.gcount()));
    pending.erase(0, pending.size() - feed(parser, pending).size());
    if (pending.size() > kLongestLine) {
      break;  // no line will be had of this
    }
  }
  if (stream.bad()) {
    throw InputError(path, "", "cannot be read: the medium reports an error");
  }
  if (!pending.empty()) {
    parser.take(pending, false);
  }
  return parser.finish();
}

}  // namespace tracking
