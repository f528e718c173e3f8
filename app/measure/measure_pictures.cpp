#include "app/measure/measure_pictures.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "app/measure/lens_marks.hpp"
#include "app/report/text.hpp"
#include "lenses/measure/lens_outline.hpp"

namespace app {
namespace {

using lenses::RayStatus;

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kPowerStep = 0.25, kPrismStep = 1.0, kThicknessStep = 0.25;  // D, prism dioptres, mm
constexpr double kLeastCylinder = 0.12;                                       // with an axis worth a stroke, D

// Short lines along the cylinder's axis, a twelfth of the map apart; power(i) is none where nothing was read.
void add_axes(MapPicture& map, lenses::CylinderForm form,
              const std::function<std::optional<glm::dvec3>(std::size_t)>& power) {
  const lenses::Grid& grid = map.field.grid;
  const std::size_t every = std::max<std::size_t>(1, (grid.columns - 1) / 12);
  const std::size_t from_middle = (grid.columns / 2) % every;
  for (std::size_t i = 0; i < grid.count(); ++i) {
    if ((i % grid.columns) % every != from_middle || (i / grid.columns) % every != from_middle) {
      continue;
    }
    const auto here = power(i);
    if (here && lenses::astigmatism(*here) >= kLeastCylinder) {
      map.strokes.push_back({grid.at(i), std::numbers::pi - sphere_cylinder(*here, form).axis});
    }
  }
}

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

// What the scale is fitted to: values inside the outline, or the lens where there is none.
bool counts(const lenses::Lens& lens, const glm::dvec2& point) {
  return lens.outline.empty() || lenses::inside_polygon(lens.outline, point);
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

  [[nodiscard]] MapPicture picture(const std::string& title, const std::string& unit, double step,
                                   const std::function<double(const lenses::WornMapReading&)>& value) const {
    MapPicture map;
    map.title = title;
    map.unit = unit;
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
    map.scale = map_scale(counted, step);
    map.note = format("%g %s a line, %s; %s", map.scale.step, unit.c_str(), view_words(viewed_by_),
                      short_name(report_).c_str());
    const ToPlot to_gaze{
        [&](const glm::dvec2& p) { return kDegrees * lenses::gaze_angles(worn_.gaze_through(p)); },
        [&](const glm::dvec2& p) { return kDegrees * lenses::gaze_angles(base_.gaze_through_front(p)); }};
    if (report_.lens.attached_to == lenses::Lens::AttachedTo::eye) {
      // It turns with the eye: no point of it belongs to a gaze.
      const glm::dvec2 low = map.field.grid.low, high = map.field.grid.high;
      map.region = {low, {high.x, low.y}, high, {low.x, high.y}};
      return map;
    }
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

using Pictures = std::vector<NamedPicture>;

void add(Pictures& pictures, const std::string& file, const std::string& caption, const MapPicture& map) {
  pictures.push_back({file + ".png", caption, draw_map(map)});
}

void add_lens_pictures(Pictures& pictures, const MeasureReport& report, const lenses::LensMap& lens_map,
                       ViewedBy viewed_by) {
  const LensPictures on_lens(report, lens_map, viewed_by);
  add(pictures, "power", "Mean back vertex power over the lens, the beam normal to the back surface at each point.",
      on_lens.picture("Back vertex power, mean", "D", kPowerStep,
                      [](const auto& r) { return if_ok(r.back, lenses::mean_power(r.back.power)); }));
  MapPicture cylinder = on_lens.picture("Cylinder, strokes along its axis", "D", kPowerStep,
                                        [](const auto& r) { return if_ok(r.back, lenses::astigmatism(r.back.power)); });
  add_axes(cylinder, report.form, [&](std::size_t i) {
    const lenses::LensmeterReading& r = lens_map.readings[i].back;
    return r.status == RayStatus::ok ? std::optional(r.power) : std::nullopt;
  });
  add(pictures, "cylinder", "Cylinder over the lens; short lines lie along its axis.", cylinder);
  MapPicture prism = on_lens.picture("Prism", "pd", kPrismStep,
                                     [](const auto& r) { return if_ok(r.back, glm::length(r.back.prism)); });
  prism.decimals = 0;
  add(pictures, "prism", "Prism over the lens, prism dioptres.", prism);
  add(pictures, "thickness", "Thickness along the lens axis.",
      on_lens.picture("Thickness along the axis", "mm", kThicknessStep,
                      [](const auto& r) { return 1e3 * r.thickness; }));
}

// One of the two distances at which a map has a reading for each gaze.
struct WornDistance {
  std::string file, title, caption;
  lenses::WornReading lenses::WornMapReading::*reading;
};

void add_worn_pictures(Pictures& pictures, const MeasureReport& report, const lenses::WornMap& worn_map,
                       const lenses::Eye& eye, ViewedBy viewed_by) {
  const WornPictures as_worn(report, worn_map, eye, viewed_by);
  const glm::dvec3 ordered = ordered_power(report);
  const std::string beyond(report.lens.order ? " beyond the order" : "");
  const WornDistance distances[]{
      {"worn", "As worn, far: ", " as worn by the turning eye, object at infinity", &lenses::WornMapReading::far},
      {"working", "At working distance: ", " as worn, object at each gaze's working distance",
       &lenses::WornMapReading::working}};
  for (const WornDistance& at : distances) {
    add(pictures, at.file + "_power", "Mean power" + at.caption + ", at the vertex sphere.",
        as_worn.picture(at.title + "mean power", "D", kPowerStep, [&](const auto& r) {
          return if_ok(r.*at.reading, lenses::mean_power((r.*at.reading).power));
        }));
    MapPicture map = as_worn.picture(at.title + "astigmatism" + beyond, "D", kPowerStep, [&](const auto& r) {
      return if_ok(r.*at.reading, lenses::astigmatism((r.*at.reading).power - ordered));
    });
    add_axes(map, report.form, [&](std::size_t i) {
      const lenses::WornReading& r = worn_map.readings[i].*at.reading;
      return r.status == RayStatus::ok ? std::optional(r.power - ordered) : std::nullopt;
    });
    add(pictures, at.file + "_astigmatism", "Astigmatism" + beyond + at.caption + "; short lines lie along its axis.",
        map);
  }
  MapPicture prism = as_worn.picture("As worn: prism", "pd", kPrismStep,
                                     [](const auto& r) { return if_ok(r.far, glm::length(r.far.prism)); });
  prism.decimals = 0;
  add(pictures, "worn_prism", "Deviation of the turning eye's line of sight, prism dioptres.", prism);
}

}  // namespace

std::vector<NamedPicture> measure_pictures(const MeasureReport& report, const lenses::LensMap& lens_map,
                                           const lenses::WornMap& worn_map, const lenses::Eye& eye,
                                           ViewedBy viewed_by) {
  Pictures pictures;
  add_lens_pictures(pictures, report, lens_map, viewed_by);
  add_worn_pictures(pictures, report, worn_map, eye, viewed_by);
  return pictures;
}

}  // namespace app
