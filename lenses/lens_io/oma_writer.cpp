// Spectacles into a job. With a job to bring up to date, whatever its own spectacles say the same as the new ones stays
// untouched; a record that changes takes the change, so that what box arithmetic rounds away does not creep in.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <stdexcept>

#include "lenses/design/lens_shape.hpp"
#include "lenses/lens_io/json_text.hpp"
#include "lenses/lens_io/oma_spectacles.hpp"
#include "lenses/lens_io/oma_trace.hpp"
#include "lenses/sag_grid.hpp"
#include "tracking/input_error.hpp"

namespace lenses {
namespace {

using io::OmaJob;
using Pair = std::array<std::optional<double>, 2>;  // right, left
using io::number_text;

constexpr double kLeastRadius = 0.020;  // m; a lesser number would read as dioptres
constexpr double kSameHeight = 5e-7;    // m, between surfaces that count as one
constexpr double kSamePoint = 1e-6;     // m, between points of outlines
constexpr double kSameNumber = 1e-4;    // of a record, in its unit
constexpr std::array<Side, 2> kSides{Side::right, Side::left};

struct Box {
  glm::dvec2 low{1e9}, high{-1e9};
  [[nodiscard]] glm::dvec2 centre() const { return 0.5 * (low + high); }
  [[nodiscard]] glm::dvec2 size() const { return high - low; }
};

Box box_of(const std::vector<glm::dvec2>& outline) {
  Box box;
  for (const glm::dvec2& point : outline) {
    box.low = glm::min(box.low, point);
    box.high = glm::max(box.high, point);
  }
  return box;
}

// A radius or a plane that FRNT and BACK can hold, in mm (0: flat); nullopt: needs a table.
std::optional<double> radius_record(const Surface& surface, const Placement& placement) {
  if (placement != Placement{}) return std::nullopt;
  if (std::holds_alternative<Plane>(surface)) return 0.0;
  const auto* sphere = std::get_if<Sphere>(&surface);
  if (sphere == nullptr) return std::nullopt;
  if (sphere->curvature == 0.0) return 0.0;
  if (std::abs(1.0 / sphere->curvature) <= kLeastRadius) return std::nullopt;
  return 1e3 / sphere->curvature;
}

struct Record {
  std::string label;
  Pair value;
  bool for_both = false;  // one number, not right;left
};

// The numbers that a job holds of spectacles.
class Records {
 public:
  Records(const Spectacles& spectacles, const std::array<double, 2>& pd, const std::optional<double>& bridge)
      : spectacles_(spectacles) {
    orders();
    making();
    frame(pd, bridge);
  }

  [[nodiscard]] const std::vector<Record>& all() const { return records_; }
  [[nodiscard]] Pair of(const std::string& label) const {
    for (const Record& record : records_) {
      if (record.label == label) return record.value;
    }
    return {};
  }

 private:
  template <class Value>
  void add(const std::string& label, Value value) {
    Record record{label, {}};
    for (const Side side : kSides) record.value[static_cast<std::size_t>(side)] = value(lens(side), side);
    if (record.value[0] || record.value[1]) records_.push_back(std::move(record));
  }
  [[nodiscard]] const Lens& lens(Side side) const { return spectacles_.lens[static_cast<std::size_t>(side)]; }

  void orders() {
    const auto ordered = [](const Lens& lens) { return lens.order ? &lens.order->ordered : nullptr; };
    const auto designed = [](const Lens& lens) {
      return lens.order && lens.order->compensated ? &*lens.order->compensated : nullptr;
    };
    power(ordered, "SPH", "CYL", "AX", "ADD");
    const auto prism = [&](const Lens& lens) -> std::optional<glm::dvec2> {
      if (!lens.order) return std::nullopt;
      return design::prism_vector(lens.order->ordered.prism);
    };
    const auto has_prism = [&](const Lens& lens) { return prism(lens).value_or(glm::dvec2(0.0)) != glm::dvec2(0.0); };
    if (has_prism(lens(Side::right)) || has_prism(lens(Side::left))) {
      add("PRVM",
          [&](const Lens& lens, Side) { return prism(lens) ? std::optional(length(*prism(lens))) : std::nullopt; });
      add("PRVA", [&](const Lens& lens, Side) -> std::optional<double> {
        if (!prism(lens)) return std::nullopt;
        if (!has_prism(lens)) return 0.0;
        const glm::dvec2 base = *prism(lens);  // the wearer's axes; the record is the viewer's
        const double angle = std::atan2(base.y, -base.x) * 180.0 / std::numbers::pi;
        return angle < 0.0 ? angle + 360.0 : angle;
      });
    }
    power(designed, "LDDRSPH", "LDDRCYL", "LDDRAX", "LDADD");
  }

  template <class Get>
  void power(Get get, const char* sphere, const char* cylinder, const char* axis, const char* addition) {
    const auto part = [&](const char* label, auto value) {
      add(label, [&](const Lens& lens, Side) -> std::optional<double> {
        const Prescription* p = get(lens);
        return p != nullptr ? std::optional<double>(value(*p)) : std::nullopt;
      });
    };
    part(sphere, [](const Prescription& p) { return p.sphere; });
    part(cylinder, [](const Prescription& p) { return p.cylinder; });
    part(axis, [](const Prescription& p) { return p.axis * 180.0 / std::numbers::pi; });
    const auto adds = [&](Side side) { return get(lens(side)) != nullptr && get(lens(side))->addition != 0.0; };
    if (adds(Side::right) || adds(Side::left)) part(addition, [](const Prescription& p) { return p.addition; });
  }

  void making() {
    constexpr double kDegree = std::numbers::pi / 180.0;
    add("BVD", [](const Lens& lens, Side) { return std::optional(1e3 * lens.fit.vertex_distance); });
    add("PANTO", [](const Lens& lens, Side) { return std::optional(lens.fit.pantoscopic_tilt / kDegree); });
    add("ZTILT", [](const Lens& lens, Side) { return std::optional(lens.fit.wrap / kDegree); });
    add("LIND", [](const Lens& lens, Side) { return std::optional(lens.index); });
    add("CTHICK", [](const Lens& lens, Side) { return std::optional(1e3 * lens.centre_thickness); });
    add("FRNT", [](const Lens& lens, Side) { return radius_record(lens.front, lens.front_placement); });
    add("BACK", [](const Lens& lens, Side) { return radius_record(lens.back, lens.back_placement); });
    point("BCSG", "IN", "UP", &ReferencePoints::fitting_cross);
    point("BCDRP", "IN", "UP", &ReferencePoints::distance);
    point("BCNRP", "IN", "UP", &ReferencePoints::near);
  }

  void point(const std::string& label, const char* in, const char* up,
             std::optional<glm::dvec2> ReferencePoints::*which) {
    add(label + in, [&](const Lens& lens, Side side) -> std::optional<double> {
      const auto& point = lens.reference_points.*which;
      return point ? std::optional((side == Side::right ? -1e3 : 1e3) * point->x) : std::nullopt;
    });
    add(label + up, [&](const Lens& lens, Side) -> std::optional<double> {
      const auto& point = lens.reference_points.*which;
      return point ? std::optional(1e3 * point->y) : std::nullopt;
    });
  }

  void frame(const std::array<double, 2>& pd, const std::optional<double>& bridge) {
    const auto traced = [&](Side side) { return !lens(side).outline.empty(); };
    if (!traced(Side::right) && !traced(Side::left)) return;
    const auto box = [](const Lens& lens) { return box_of(lens.outline); };
    // The pupil from the box's centre: in is towards the nose.
    const auto pupil = [&](const Lens& lens, Side side) {
      const glm::dvec2 p = -lens.fit.decentration - box(lens).centre();
      return glm::dvec2(side == Side::right ? -p.x : p.x, p.y);
    };
    const auto given = [&](const Lens& lens, double value) {
      return lens.outline.empty() ? std::nullopt : std::optional(1e3 * value);
    };
    const Side known = traced(Side::right) ? Side::right : Side::left;
    const double width = bridge.value_or(2.0 * (pd[static_cast<std::size_t>(known)] + pupil(lens(known), known).x) -
                                         box(lens(known)).size().x);
    add("HBOX", [&](const Lens& lens, Side) { return given(lens, box(lens).size().x); });
    add("VBOX", [&](const Lens& lens, Side) { return given(lens, box(lens).size().y); });
    records_.push_back({"DBL", {1e3 * width, 1e3 * width}, true});
    add("IPD", [&](const Lens& lens, Side side) {
      return given(lens, 0.5 * (box(lens).size().x + width) - pupil(lens, side).x);
    });
    const auto progressive = [](const Lens& lens) { return lens.reference_points.fitting_cross.has_value(); };
    const auto height = [&](const Lens& lens, Side side) { return pupil(lens, side).y + 0.5 * box(lens).size().y; };
    add("SEGHT", [&](const Lens& lens, Side side) {
      return progressive(lens) ? given(lens, height(lens, side)) : std::nullopt;
    });
    add("OCHT", [&](const Lens& lens, Side side) {
      return progressive(lens) ? std::nullopt : given(lens, height(lens, side));
    });
  }

  const Spectacles& spectacles_;
  std::vector<Record> records_;
};

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
    before_ = spectacles_of(job_, {.rows = writing.rows}).spectacles;
  }

  [[nodiscard]] OmaJob write() {
    std::optional<double> bridge;
    if (before_) bridge = read_order(job_, writing_.rows).bridge;
    if (!before_) {
      add_line("JOB=" + job_name());
      add_line("DO=B");
      add_line(std::string("LTYPE=") + type_word(Side::right) + ";" + type_word(Side::left));
    }
    const Records now(spectacles_, writing_.pupillary_distance, bridge);
    const Records then(before_ ? *before_ : Spectacles{}, writing_.pupillary_distance, bridge);
    for (const Record& record : now.all()) set(record, before_ ? then.of(record.label) : Pair{});
    if (!before_ || !same_outlines()) write_traces();
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

  void set(const Record& record, const Pair& then) {
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
  std::optional<Spectacles> before_;
};

}  // namespace

io::OmaJob job_of(const Spectacles& spectacles, const std::string& file, const JobWriting& writing) {
  return JobWriter(spectacles, file, writing).write();
}

}  // namespace lenses
