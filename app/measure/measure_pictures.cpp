#include "app/measure/measure_pictures.hpp"

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "app/report/text.hpp"
#include "lenses/measure/lens_outline.hpp"

namespace app {
namespace {

using lenses::RayStatus;

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kPowerStep = 0.25, kPrismStep = 1.0, kThicknessStep = 0.25;  // D, prism dioptres, mm
constexpr double kLeastCylinder = 0.12;                                       // with an axis worth a stroke, D

// From a point of the back (reference points, outline) and of the front (segments) to its place in the plot.
struct ToPlot {
  std::function<glm::dvec2(const glm::dvec2&)> from_back, from_front;
};

const char* view_words(ViewedBy viewed_by) {
  return viewed_by == ViewedBy::wearer ? "as the wearer sees it" : "as the examiner sees it";
}

// As much of the file's name, without its folders, as a picture has room for.
std::string short_name(const MeasureReport& report) {
  constexpr std::size_t kRoom = 34;
  return report.source.substr(report.source.rfind('/') + 1).substr(0, kRoom);
}

void set_sides(MapPicture& map, const MeasureReport& report, ViewedBy viewed_by) {
  const bool nose_at_left = report.side == lenses::Side::right;  // of the wearer
  map.left = nose_at_left ? "nose" : "temple";
  map.right = nose_at_left ? "temple" : "nose";
  map.mirrored = viewed_by == ViewedBy::examiner;
}

// Straight edges of the lens may be curves in the plot.
std::vector<glm::dvec2> plotted(const std::vector<glm::dvec2>& polygon,
                                const std::function<glm::dvec2(const glm::dvec2&)>& to_plot) {
  const int parts = polygon.size() < 100 ? 16 : 1;
  std::vector<glm::dvec2> line;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    for (int k = 0; k < parts; ++k) {
      line.push_back(to_plot(a + (b - a) * (static_cast<double>(k) / parts)));
    }
  }
  return line;
}

void add_lens_marks(MapPicture& map, const lenses::Lens& lens, const ToPlot& to_plot) {
  const lenses::ReferencePoints& points = lens.reference_points;
  const auto add = [&](MapMark::Shape shape, const std::optional<glm::dvec2>& at, const char* label) {
    if (at) {
      map.marks.push_back({shape, to_plot.from_back(*at), label});
    }
  };
  add(MapMark::Shape::cross, points.fitting_cross, "");
  add(MapMark::Shape::circle, points.distance, "D");
  add(MapMark::Shape::circle, points.near, "N");
  add(MapMark::Shape::dot, lenses::prism_point(lens), "P");
  if (!lens.outline.empty()) {
    map.outlines.push_back(plotted(lens.outline, to_plot.from_back));
  }
  // Numbers as zone_of (lenses/measure/zone.hpp) gives them.
  if (const auto* segmented = std::get_if<lenses::SegmentedSurface>(&lens.back)) {
    map.zones.push_back({plotted(segmented->boundary, to_plot.from_back), 1});
  }
  if (const auto* segmented = std::get_if<lenses::SegmentedSurface>(&lens.front)) {
    map.zones.push_back({plotted(segmented->boundary, to_plot.from_front), 2});
  }
}

// What the scale is fitted to: values inside the outline, or the lens where there is none.
bool counts(const lenses::Lens& lens, const glm::dvec2& point) {
  return lens.outline.empty() || lenses::inside_polygon(lens.outline, point);
}

// The lens as it would be without segments.
lenses::Lens without_segments(lenses::Lens lens) {
  for (lenses::Surface* surface : {&lens.front, &lens.back}) {
    if (const auto* segmented = std::get_if<lenses::SegmentedSurface>(surface)) {
      const lenses::BasicSurface base = segmented->base;
      *surface = std::visit([](const auto& shape) { return lenses::Surface(shape); }, base);
    }
  }
  return lens;
}

// Where a lensmeter's beam that meets the front at a point meets the back.
glm::dvec2 back_of_front_point(const lenses::Lensmeter& lensmeter, const glm::dvec2& point) {
  constexpr int kSteps = 12;
  glm::dvec2 back = point;
  for (int i = 0; i < kSteps; ++i) {
    const lenses::LensmeterReading reading = lensmeter.read(lenses::LensSide::back, back);
    if (reading.status != RayStatus::ok) {
      return point;
    }
    back += point - reading.far_point;
  }
  return back;
}

class LensPictures {
 public:
  LensPictures(const MeasureReport& report, const lenses::LensMap& map, ViewedBy viewed_by)
      : report_(report), map_(map), viewed_by_(viewed_by), base_(without_segments(report.lens)) {}

  [[nodiscard]] MapPicture picture(const std::string& title, const std::string& unit, double step,
                                   const std::function<double(const lenses::LensMapReading&)>& value) const {
    MapPicture map;
    map.title = title;
    map.unit = unit;
    map.x_label = "x mm";
    map.y_label = "y mm";
    set_sides(map, report_, viewed_by_);
    map.field.grid = {1e3 * map_.grid.low, 1e3 * map_.grid.high, map_.grid.columns, map_.grid.rows};
    std::vector<double> counted;
    for (std::size_t i = 0; i < map_.readings.size(); ++i) {
      map.field.values.push_back(value(map_.readings[i]));
      map.field.zones.push_back(map_.readings[i].back.zone);
      if (counts(report_.lens, map_.grid.at(i))) {
        counted.push_back(map.field.values.back());
      }
    }
    map.scale = map_scale(counted, step);
    set_note(map, unit);
    const ToPlot to_mm{[](const glm::dvec2& p) { return 1e3 * p; },
                       [&](const glm::dvec2& p) { return 1e3 * back_of_front_point(base_, p); }};
    map.region = plotted(lenses::blank_of(report_.lens), to_mm.from_back);
    add_lens_marks(map, report_.lens, to_mm);
    return map;
  }

  // Short lines along the cylinder's axis, about 6 mm apart on a lens of 65 mm.
  void add_axes(MapPicture& map) const {
    const std::size_t every = std::max<std::size_t>(1, (map_.grid.columns - 1) / 12);
    for (std::size_t i = 0; i < map_.readings.size(); ++i) {
      const lenses::LensmeterReading& reading = map_.readings[i].back;
      const std::size_t from_middle = (map_.grid.columns / 2) % every;
      const bool chosen =
          (i % map_.grid.columns) % every == from_middle && (i / map_.grid.columns) % every == from_middle;
      if (!chosen || reading.status != RayStatus::ok || lenses::astigmatism(reading.power) < kLeastCylinder) {
        continue;
      }
      const double tabo = sphere_cylinder(reading.power, report_.form).axis;
      map.strokes.push_back({map.field.grid.at(i), std::numbers::pi - tabo});
    }
  }

  void set_note(MapPicture& map, const std::string& unit) const {
    map.note = format("%g %s a line, %s; %s", map.scale.step, unit.c_str(), view_words(viewed_by_),
                      short_name(report_).c_str());
  }

 private:
  const MeasureReport& report_;
  const lenses::LensMap& map_;
  ViewedBy viewed_by_;
  lenses::Lensmeter base_;
};

class WornPictures {
 public:
  WornPictures(const MeasureReport& report, const lenses::WornMap& map, const lenses::Eye& eye, ViewedBy viewed_by)
      : report_(report),
        map_(map),
        worn_(report.lens, report.side, eye),
        base_(without_segments(report.lens), report.side, eye),
        viewed_by_(viewed_by) {}

  [[nodiscard]] MapPicture picture(const std::string& title,
                                   const std::function<double(const lenses::WornMapReading&)>& value) const {
    MapPicture map;
    map.title = title;
    map.unit = std::string("D");
    map.x_label = "gaze, deg to the wearer's right";
    map.y_label = "deg up";
    set_sides(map, report_, viewed_by_);
    map.field.grid = {kDegrees * map_.grid.low, kDegrees * map_.grid.high, map_.grid.columns, map_.grid.rows};
    std::vector<double> counted;
    for (std::size_t i = 0; i < map_.readings.size(); ++i) {
      const lenses::WornMapReading& reading = map_.readings[i];
      map.field.values.push_back(value(reading));
      map.field.zones.push_back(reading.far.zone);
      if (reading.far.status == RayStatus::ok && counts(report_.lens, reading.far.back_point)) {
        counted.push_back(map.field.values.back());
      }
    }
    map.scale = map_scale(counted, kPowerStep);
    map.note = format("%g D a line, %s; %s", map.scale.step, view_words(viewed_by_), short_name(report_).c_str());
    const ToPlot to_gaze{
        [&](const glm::dvec2& p) { return kDegrees * lenses::gaze_angles(worn_.gaze_through(p)); },
        [&](const glm::dvec2& p) { return kDegrees * lenses::gaze_angles(base_.gaze_through_front(p)); }};
    map.region = plotted(lenses::blank_of(report_.lens), to_gaze.from_back);
    add_lens_marks(map, report_.lens, to_gaze);
    return map;
  }

 private:
  const MeasureReport& report_;
  const lenses::WornMap& map_;
  lenses::WornLens worn_, base_;
  ViewedBy viewed_by_;
};

double if_ok(const lenses::WornReading& reading, double value) {
  return reading.status == RayStatus::ok ? value : kNone;
}

double if_ok(const lenses::LensmeterReading& reading, double value) {
  return reading.status == RayStatus::ok ? value : kNone;
}

}  // namespace

std::vector<NamedPicture> measure_pictures(const MeasureReport& report, const lenses::LensMap& lens_map,
                                           const lenses::WornMap& worn_map, const lenses::Eye& eye,
                                           ViewedBy viewed_by) {
  std::vector<NamedPicture> pictures;
  const auto add = [&](const std::string& file, const std::string& caption, const MapPicture& map) {
    pictures.push_back({file + ".png", caption, draw_map(map)});
  };
  const LensPictures on_lens(report, lens_map, viewed_by);
  add("power", "Mean back vertex power over the lens, the beam normal to the back surface at each point.",
      on_lens.picture("Back vertex power, mean", "D", kPowerStep,
                      [](const auto& r) { return if_ok(r.back, lenses::mean_power(r.back.power)); }));
  MapPicture cylinder = on_lens.picture("Cylinder, strokes along its axis", "D", kPowerStep,
                                        [](const auto& r) { return if_ok(r.back, lenses::astigmatism(r.back.power)); });
  on_lens.add_axes(cylinder);
  add("cylinder", "Cylinder over the lens; short lines lie along its axis.", cylinder);
  MapPicture prism = on_lens.picture("Prism", "pd", kPrismStep,
                                     [](const auto& r) { return if_ok(r.back, glm::length(r.back.prism)); });
  prism.decimals = 0;
  add("prism", "Prism over the lens, prism dioptres.", prism);
  add("thickness", "Thickness along the lens axis.",
      on_lens.picture("Thickness along the axis", "mm", kThicknessStep,
                      [](const auto& r) { return 1e3 * r.thickness; }));

  const WornPictures as_worn(report, worn_map, eye, viewed_by);
  add("worn_power", "Mean power as worn by the turning eye, object at infinity, at the vertex sphere.",
      as_worn.picture("As worn, far: mean power",
                      [](const auto& r) { return if_ok(r.far, lenses::mean_power(r.far.power)); }));
  const glm::dvec3 ordered = ordered_power(report);
  const std::string beyond(report.lens.order ? " beyond the order" : "");
  add("worn_astigmatism", "Astigmatism" + beyond + " as worn, object at infinity.",
      as_worn.picture("As worn, far: astigmatism" + beyond,
                      [&](const auto& r) { return if_ok(r.far, lenses::astigmatism(r.far.power - ordered)); }));
  add("working_power", "Mean power as worn with the object at each gaze's working distance.",
      as_worn.picture("As worn, at working distance: mean power",
                      [](const auto& r) { return if_ok(r.working, lenses::mean_power(r.working.power)); }));
  add("working_astigmatism", "Astigmatism" + beyond + " as worn with the object at each gaze's working distance.",
      as_worn.picture("As worn, at working distance: astigmatism" + beyond,
                      [&](const auto& r) { return if_ok(r.working, lenses::astigmatism(r.working.power - ordered)); }));
  return pictures;
}

}  // namespace app
