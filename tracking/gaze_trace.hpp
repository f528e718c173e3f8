// Recorded poses and gaze, a CSV line a frame:
//   time_s,head_px,head_py,head_pz,head_qx,head_qy,head_qz,head_qw,left_gx,left_gy,left_gz,right_gx,right_gy,right_gz,
//   gaze_valid
// Metres, a unit quaternion, gaze directions in head axes; gaze_valid is 0 during blinks and loss. Further columns may
// follow; ours are left_pupil_m, right_pupil_m, left_accommodation_D, right_accommodation_D (all four or none of them),
// gaze_source, and b_left_gx, b_left_gy, b_left_gz, b_right_gx, b_right_gy, b_right_gz, b_left_accommodation_D,
// b_right_accommodation_D (all eight or none: the eyes behind a second pair, zeros where there is none). Others are
// passed over.
#pragma once

#include <array>
#include <cstddef>
#include <cstdio>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tracking/gaze_follower.hpp"
#include "tracking/stereo_view.hpp"

namespace tracking {

// What both eyes were in a frame, indexed by Side.
struct EyesInFrame {
  std::array<double, 2> pupil_diameter{};  // m
  std::array<double, 2> accommodation{};   // D
  bool operator==(const EyesInFrame&) const = default;
};

// The same eyes behind a second pair of spectacles, which turn and accommodate otherwise; indexed by Side.
struct EyesBehindSecond {
  std::array<glm::dvec3, 2> gaze{};  // head axes, unit
  std::array<double, 2> accommodation{};
  bool operator==(const EyesBehindSecond&) const = default;
};

struct TraceRow {
  double time = 0.0;  // s
  Pose head;          // world_from_head
  // Head axes, indexed by Side; unit where gaze_valid, else whatever was written, perhaps 0.
  std::array<glm::dvec3, 2> gaze{glm::dvec3(0.0, 0.0, -1.0), glm::dvec3(0.0, 0.0, -1.0)};
  bool gaze_valid = true;
  std::optional<EyesInFrame> eyes;
  std::optional<GazeSource> source;
  std::optional<EyesBehindSecond> second = {};
};

struct GazeTrace {
  std::vector<TraceRow> rows;  // at least one; times increase
  bool last_line_cut = false;  // the file ends within a line, as after a full disk; that line is left out
};

// Strict: whatever is not understood is an InputError with the line and the column. Line ends are LF or CRLF. A
// quaternion or a direction within 1e-6 of unit length stays as it is, bit for bit; quaternions within 1e-3 and
// directions of any length are normalised, others refused.
[[nodiscard]] GazeTrace parse_gaze_trace(std::string_view text, const std::string& file);
// The same from a file, of which no more than a piece is held in memory beside the rows.
[[nodiscard]] GazeTrace read_gaze_trace(const std::string& path);

// Writes a trace line by line and hands each to the system at once: a crash of the program loses no line.
class GazeTraceWriter {
 public:
  struct Columns {
    bool eyes = true, source = true, second = false;
  };

  // Replaces the file. Throws std::runtime_error where it cannot be written.
  explicit GazeTraceWriter(const std::string& path) : GazeTraceWriter(path, Columns{}) {}
  GazeTraceWriter(const std::string& path, const Columns& columns);

  // False, and nothing written, for a row that no reader would take: numbers that are not finite, a time not later than
  // the last row's, a quaternion that is none. Columns that the row has no values for hold zeros. Throws
  // std::runtime_error where the disk refuses.
  bool write(const TraceRow& row);

  [[nodiscard]] std::size_t rows() const { return rows_; }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  void put(const std::string& line);

  std::string path_;
  Columns columns_;
  std::unique_ptr<std::FILE, Close> file_;
  std::optional<double> last_time_;
  std::size_t rows_ = 0;
};

}  // namespace tracking
