// Spectacles into a job. With a job to bring up to date, whatever its own spectacles say the same as the new ones stays
// untouched; a record that changes takes the change, so that what box arithmetic rounds away does not creep in.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <stdexcept>

#include "lenses/design/lens_shape.hpp"
#include "lenses/lens_io/json_text.hpp"
#include "lenses/lens_io/oma_records.hpp"
#include "lenses/lens_io/oma_spectacles.hpp"
#include "lenses/lens_io/oma_trace.hpp"
#include "lenses/sag_grid.hpp"
#include "tracking/input_error.hpp"

namespace lenses {
namespace {

using io::box_of;
using io::OmaJob;
using io::radius_record;
using Pair = io::OmaNumber::Pair;
using io::number_text;

constexpr double kSameHeight = 5e-7;  // m, between surfaces that count as one
constexpr double kSamePoint = 1e-6;   // m, between points of outlines
constexpr double kSameNumber = 1e-4;  // of a record, in its unit
constexpr std::array<Side, 2> kSides{Side::right, Side::left};

std::string value_text(const std::optional<double>& value) {
  if (!value) return "?";
  const double rounded = std::round(*value * 1e4) / 1e4;
  return number_text(rounded == 0.0 ? 0.0 : rounded);
}

class JobWriter {
 public:
  JobWriter(const Spectacles& spectacles, const std::string& file, const JobWriting& writing)
      : spectacles_(spectacles), file_(file), writing_(writing) {
    if (!writing.base) return;
    job_ = *writing.base;
    bridge_ = read_order(job_, writing_.rows).bridge;
    try {
      before_ = spectacles_of(job_, {.rows = writing.rows}).spectacles;
    } catch (const tracking::InputError&) {
      // A job that makes no lens, of a frame alone for instance: everything in it is new.
    }
  }

  [[nodiscard]] OmaJob write() {
    if (!writing_.base) {
      add_line("JOB=" + job_name());
      add_line("DO=B");
      add_line(std::string("LTYPE=") + type_word(Side::right) + ";" + type_word(Side::left));
    }
    const std::vector<io::OmaNumber> now = io::numbers_of(spectacles_, writing_.pupillary_distance, bridge_);
    const std::vector<io::OmaNumber> then =
        io::numbers_of(before_ ? *before_ : Spectacles{}, writing_.pupillary_distance, bridge_);
    for (const io::OmaNumber& number : now) {
      const auto same = std::ranges::find(then, number.label, &io::OmaNumber::label);
      set(number, before_ && same != then.end() ? same->value : Pair{});
    }
    if (!before_ ? has_outline() : !same_outlines()) write_traces();
    if (!before_ || !same_surfaces()) write_surfaces();
    return std::move(job_);
  }

 private:
  [[noreturn]] void fail(Side side, const char* field, const std::string& reason) const {
    throw tracking::InputError(file_, std::string(side == Side::right ? "right." : "left.") + field, reason);
  }

  // The spectacles' name on one line and with nothing that separates fields.
  [[nodiscard]] std::string job_name() const {
    std::string name = spectacles_.name.empty() ? "1" : spectacles_.name;
    std::ranges::replace_if(
        name, [](unsigned char c) { return c < 0x20 || c == 0x7f || c == ';' || c == ',' || c == '='; }, ' ');
    return name;
  }

  [[nodiscard]] const char* type_word(Side side) const {
    return spectacles_.lens[static_cast<std::size_t>(side)].reference_points.fitting_cross ? "PR" : "SV";
  }

  void add_line(const std::string& text) {
    const std::string ending =
        job_.lines.empty() || job_.lines.front().ending.empty() ? "\r\n" : job_.lines.front().ending;
    if (!job_.lines.empty() && job_.lines.back().ending.empty()) job_.lines.back().ending = ending;
    job_.lines.push_back({text, ending});
  }

  void set(const io::OmaNumber& record, const Pair& then) {
    Pair value = record.value;
    bool same = before_.has_value();
    for (const Side side : kSides) {
      const auto i = static_cast<std::size_t>(side);
      same = same && value[i].has_value() == then[i].has_value() &&
             (!value[i] || std::abs(*value[i] - *then[i]) < kSameNumber);
      const bool radius = record.label == "FRNT" || record.label == "BACK";  // or dioptres
      if (!value[i] || !then[i] || radius) continue;
      const auto written = job_.number_of(record.label, side, -1e9, 1e9);
      if (written) value[i] = *written + (*value[i] - *then[i]);
    }
    if (same) return;
    const bool lone = record.for_both;
    job_.set(record.label, lone ? value_text(value[0]) : value_text(value[0]) + ";" + value_text(value[1]));
  }

  [[nodiscard]] bool has_outline() const {
    return std::ranges::any_of(spectacles_.lens, [](const Lens& lens) { return !lens.outline.empty(); });
  }

  // The same shape, wherever it lies: traces start at the box's centre.
  [[nodiscard]] bool same_outlines() const {
    return std::ranges::all_of(kSides, [&](Side side) {
      const auto &a = spectacles_.lens[static_cast<std::size_t>(side)].outline,
                 &b = before_->lens[static_cast<std::size_t>(side)].outline;
      if (a.size() != b.size()) return false;
      for (std::size_t i = 0; i < a.size(); ++i) {
        if (distance(a[i] - a[0], b[i] - b[0]) > kSamePoint) return false;
      }
      return true;
    });
  }

  [[nodiscard]] bool same_surfaces() const {
    return std::ranges::all_of(kSides, [&](Side side) {
      const Lens &a = spectacles_.lens[static_cast<std::size_t>(side)],
                 &b = before_->lens[static_cast<std::size_t>(side)];
      const design::LensShape now(a), then(b);
      constexpr int kRings = 12, kSpokes = 24;
      for (int k = 0; k <= kRings * kSpokes; ++k) {
        const double radius = 0.5 * std::min(a.diameter, b.diameter) * (k / kSpokes) / kRings;
        const double angle = 2.0 * std::numbers::pi * (k % kSpokes) / kSpokes;
        const glm::dvec2 at = radius * glm::dvec2(std::cos(angle), std::sin(angle));
        // LensShape::front counts from the back vertex.
        const double front = now.front(at).z + a.centre_thickness - then.front(at).z - b.centre_thickness;
        const double back = now.back(at).z - then.back(at).z;
        if (!(std::abs(front) < kSameHeight && std::abs(back) < kSameHeight)) return false;
      }
      return true;
    });
  }

  void remove(std::initializer_list<std::string_view> labels) {
    std::erase_if(job_.lines,
                  [&](const io::OmaLine& line) { return std::ranges::find(labels, line.label()) != labels.end(); });
  }

  void write_traces() {
    remove({"TRCFMT", "R", "A"});
    for (const Side side : kSides) {
      std::vector<glm::dvec2> outline = spectacles_.lens[static_cast<std::size_t>(side)].outline;
      if (outline.empty()) continue;
      const glm::dvec2 centre = box_of(outline).centre();
      for (glm::dvec2& point : outline) point -= centre;
      try {
        for (const std::string& line : io::trace_lines(outline, side)) add_line(line);
      } catch (const std::invalid_argument& error) {
        fail(side, "outline", error.what());
      }
    }
  }

  void write_surfaces() {
    remove({"SURFMT", "ZZ"});
    for (const Side side : kSides) {
      const Lens& lens = spectacles_.lens[static_cast<std::size_t>(side)];
      if (!radius_record(lens.front, lens.front_placement)) write_surface(lens, side, Face::front);
      if (!radius_record(lens.back, lens.back_placement)) write_surface(lens, side, Face::back);
    }
  }

  void write_surface(const Lens& lens, Side side, Face face) {
    const char* name = face == Face::front ? "front" : "back";
    std::string text;
    try {
      text = to_sdf(sag_grid(lens, face, writing_.grid), {.rows = writing_.rows, .side = side, .face = face});
    } catch (const std::invalid_argument& error) {
      fail(side, name, error.what());
    }
    for (const io::OmaLine& line : io::parse_oma(text, file_).lines) add_line(line.text);
  }

  const Spectacles& spectacles_;
  const std::string& file_;
  const JobWriting& writing_;
  OmaJob job_;
  std::optional<Spectacles> before_;  // what the job to bring up to date makes
  std::optional<double> bridge_;      // m
};

}  // namespace

io::OmaJob job_of(const Spectacles& spectacles, const std::string& file, const JobWriting& writing) {
  try {
    return JobWriter(spectacles, file, writing).write();
  } catch (const std::invalid_argument& error) {
    throw tracking::InputError(file, "", error.what());  // a parametric patch that folds over
  }
}

}  // namespace lenses
