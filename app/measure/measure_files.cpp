#include "app/measure/measure_files.hpp"

#include <numbers>

#include "app/report/csv.hpp"

namespace app {
namespace {

using lenses::RayStatus;

constexpr double kDegrees = 180.0 / std::numbers::pi;

void add_power(Csv& csv, const glm::dvec3& power, lenses::CylinderForm form, bool ok) {
  if (!ok) {
    csv.empty(3);
    return;
  }
  const lenses::Refraction found = sphere_cylinder(power, form);
  csv.add(found.sphere).add(found.cylinder).add(axis_degrees(found));
}

void add_prism(Csv& csv, const glm::dvec2& vector, bool ok) {
  if (!ok) {
    csv.empty(2);
    return;
  }
  const lenses::Prism prism = lenses::to_prism(vector);
  csv.add(prism.magnitude).add(base_degrees(prism));
}

std::optional<double> if_ok(bool ok, double value) {
  return ok ? std::optional<double>(value) : std::nullopt;
}

}  // namespace

std::string readings_csv(const MeasureReport& report) {
  Csv csv("point,surface,x_mm,y_mm,status,sphere_D,cylinder_D,axis_deg,prism_pd,base_deg");
  for (const lenses::PointReading& point : report.readings.points) {
    const bool ok = point.reading.status == RayStatus::ok;
    csv.add(name(point.point)).add(name(point.side)).add(1e3 * point.at.x).add(1e3 * point.at.y);
    csv.add(name(point.reading.status));
    add_power(csv, point.reading.power, report.form, ok);
    add_prism(csv, point.reading.prism, ok);
    csv.end_row();
  }
  return csv.text();
}

std::string verdict_csv(const lenses::Verdict& verdict) {
  Csv csv("standard,against,tolerance,unit,measured,target,difference,limit,pass");
  for (const lenses::Check& check : verdict.checks) {
    csv.add(verdict.standard).add(verdict.against_compensated ? "compensated" : "ordered");
    csv.add(check.tolerance).add(check.unit).add(check.measured).add(check.target).add(check.difference);
    csv.add(check.limit).add(check.pass ? "yes" : "no").end_row();
  }
  return csv.text();
}

std::string lens_map_csv(const lenses::LensMap& map, lenses::CylinderForm form) {
  Csv csv("x_mm,y_mm,status,power_D,sphere_D,cylinder_D,axis_deg,prism_pd,base_deg,thickness_mm");
  for (std::size_t i = 0; i < map.readings.size(); ++i) {
    const lenses::LensMapReading& reading = map.readings[i];
    const bool ok = reading.back.status == RayStatus::ok;
    const glm::dvec2 at = 1e3 * map.grid.at(i);
    csv.add(at.x).add(at.y).add(name(reading.back.status)).add(if_ok(ok, lenses::mean_power(reading.back.power)));
    add_power(csv, reading.back.power, form, ok);
    add_prism(csv, reading.back.prism, ok);
    csv.add(1e3 * reading.thickness).end_row();
  }
  return csv.text();
}

std::string worn_map_csv(const lenses::WornMap& map, const MeasureReport& report) {
  Csv csv(
      "yaw_deg,pitch_deg,status,x_mm,y_mm,power_D,sphere_D,cylinder_D,axis_deg,unwanted_D,prism_pd,base_deg,"
      "working_vergence_D,working_status,working_power_D,working_sphere_D,working_cylinder_D,working_axis_deg,"
      "working_unwanted_D");
  const glm::dvec3 ordered = ordered_power(report);
  for (std::size_t i = 0; i < map.readings.size(); ++i) {
    const lenses::WornMapReading& reading = map.readings[i];
    const bool far = reading.far.status == RayStatus::ok, working = reading.working.status == RayStatus::ok;
    const glm::dvec2 at = kDegrees * map.grid.at(i);
    csv.add(at.x).add(at.y).add(name(reading.far.status));
    csv.add(if_ok(far, 1e3 * reading.far.back_point.x)).add(if_ok(far, 1e3 * reading.far.back_point.y));
    csv.add(if_ok(far, lenses::mean_power(reading.far.power)));
    add_power(csv, reading.far.power, report.form, far);
    csv.add(if_ok(far, lenses::astigmatism(reading.far.power - ordered)));
    add_prism(csv, reading.far.prism, far);
    csv.add(reading.object_vergence).add(name(reading.working.status));
    csv.add(if_ok(working, lenses::mean_power(reading.working.power)));
    add_power(csv, reading.working.power, report.form, working);
    csv.add(if_ok(working, lenses::astigmatism(reading.working.power - ordered)));
    csv.end_row();
  }
  return csv.text();
}

}  // namespace app
