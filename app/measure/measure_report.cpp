#include "app/measure/measure_report.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "app/report/text.hpp"

namespace app {
namespace {

using lenses::LensSide;
using lenses::RayStatus;
using nlohmann::ordered_json;

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kPrintsAsNothing = 0.005;  // D or prism dioptres

std::string padded(const std::string& text, std::size_t width) {
  return text.size() < width ? std::string(width - text.size(), ' ') + text : text;
}

std::string millimetres(std::optional<double> metres) {
  return metres ? number(1e3 * *metres, 2) : "-";
}

std::string first_line(const MeasureReport& report) {
  std::ostringstream out;
  out << report.source << ": " << name(report.lens_class) << ", index " << number(report.lens.index, 3) << ", blank "
      << number(1e3 * report.lens.diameter, 1) << " mm, centre " << millimetres(report.centre_thickness) << " mm";
  if (report.edge) {
    out << ", " << (report.lens.outline.empty() ? "rim " : "edge of the outline ")
        << millimetres(report.edge->least.thickness) << " to " << millimetres(report.edge->greatest.thickness) << " mm";
  }
  return out.str() + "\n";
}

std::string reading_line(const MeasureReport& report, const lenses::PointReading& point) {
  std::ostringstream out;
  const std::string label = std::string(name(point.point));
  out << label << std::string(10 - label.size(), ' ') << name(point.side) << (point.side == LensSide::back ? "  " : " ")
      << padded(number(1e3 * point.at.x, 2), 8) << padded(number(1e3 * point.at.y, 2), 8);
  if (point.reading.status != RayStatus::ok) {
    out << "  no reading: " << name(point.reading.status) << "\n";
    return out.str();
  }
  const lenses::Refraction found = sphere_cylinder(point.reading.power, report.form);
  const lenses::Prism prism = lenses::to_prism(point.reading.prism);
  out << padded(signed_number(found.sphere, 2), 9) << padded(signed_number(found.cylinder, 2), 10)
      << padded(number(axis_degrees(found), 1), 7) << padded(number(prism.magnitude, 2), 8)
      << padded(number(base_degrees(prism), 0), 6) << "\n";
  return out.str();
}

std::string check_line(const lenses::Check& check) {
  const bool plain = check.tolerance == "axis" || check.tolerance == "prism";
  const auto value = [&](std::optional<double> v) { return plain ? number(v, 2) : signed_number(v, 2); };
  std::string line = check.tolerance + std::string(19 - check.tolerance.size(), ' ');
  line += padded(value(check.measured), 9) + padded(value(check.target), 9) +
          padded(signed_number(check.difference, 3), 12) + padded(number(check.limit, 3), 8) + "  " + check.unit;
  return line + std::string(5 - check.unit.size(), ' ') + (check.pass ? "pass" : "FAIL") + "\n";
}

ordered_json number_or_null(std::optional<double> value) {
  return value ? ordered_json(*value) : ordered_json();
}

ordered_json mm(const glm::dvec2& p) {
  return ordered_json::array({1e3 * p.x, 1e3 * p.y});
}

ordered_json reading_json(const MeasureReport& report, const lenses::PointReading& point) {
  ordered_json j{{"point", name(point.point)},
                 {"surface", name(point.side)},
                 {"at_mm", mm(point.at)},
                 {"status", name(point.reading.status)}};
  const bool ok = point.reading.status == RayStatus::ok;
  const lenses::Refraction found = sphere_cylinder(point.reading.power, report.form);
  const lenses::Prism prism = lenses::to_prism(point.reading.prism);
  const auto unless_missing = [&](double value) { return ok ? ordered_json(value) : ordered_json(); };
  j["sphere_D"] = unless_missing(found.sphere);
  j["cylinder_D"] = unless_missing(found.cylinder);
  j["axis_deg"] = ok ? number_or_null(axis_degrees(found)) : ordered_json();
  j["prism_pd"] = unless_missing(prism.magnitude);
  j["base_deg"] = ok ? number_or_null(base_degrees(prism)) : ordered_json();
  return j;
}

ordered_json verdict_json(const lenses::Verdict& verdict) {
  ordered_json j{{"standard", verdict.standard},
                 {"against", verdict.against_compensated ? "compensated" : "ordered"},
                 {"pass", verdict.pass()},
                 {"checks", ordered_json::array()}};
  for (const lenses::Check& check : verdict.checks) {
    j["checks"].push_back({{"tolerance", check.tolerance},
                           {"unit", check.unit},
                           {"measured", number_or_null(check.measured)},
                           {"target", check.target},
                           {"difference", number_or_null(check.difference)},
                           {"limit", check.limit},
                           {"pass", check.pass}});
  }
  return j;
}

}  // namespace

std::optional<double> axis_degrees(const lenses::Refraction& refraction) {
  return std::abs(refraction.cylinder) < kPrintsAsNothing ? std::nullopt
                                                          : std::optional<double>(refraction.axis * kDegrees);
}

std::optional<double> base_degrees(const lenses::Prism& prism) {
  return prism.magnitude < kPrintsAsNothing ? std::nullopt : std::optional<double>(prism.base * kDegrees);
}

MeasureReport measure_lens(const std::string& source, const lenses::Lens& lens, lenses::Side side,
                           lenses::CylinderForm form, lenses::LensClass lens_class,
                           const lenses::ToleranceStandard& standard, const std::optional<lenses::Lens>& other) {
  const lenses::Lensmeter lensmeter(lens);
  MeasureReport report;
  report.source = source;
  report.lens = lens;
  report.side = side;
  report.form = form;
  report.lens_class = lens_class;
  report.readings = read_lens_powers(lens, lensmeter);
  report.centre_thickness = lensmeter.thickness(glm::dvec2(0.0));
  report.edge = edge_thickness(lens, lensmeter);
  if (lens.order && lens.attached_to == lenses::Lens::AttachedTo::head) {
    report.verdict = judge(standard, lens_class, report.readings, *lens.order);
    if (other) {
      const lenses::LensReadings theirs = read_lens_powers(*other, lenses::Lensmeter(*other));
      if (const auto check = vertical_imbalance(standard, report.readings, lens.order, theirs, other->order)) {
        report.verdict->checks.push_back(*check);
      }
    }
  }
  return report;
}

glm::dvec3 ordered_power(const MeasureReport& report) {
  if (!report.lens.order) {
    return glm::dvec3(0.0);
  }
  const lenses::Prescription& rx = report.lens.order->ordered;
  return lenses::power_matrix({rx.sphere, rx.cylinder, rx.axis});
}

std::string verdict_line(const MeasureReport& report) {
  if (report.lens.attached_to == lenses::Lens::AttachedTo::eye) {
    return "No verdict: the tolerances are for spectacle lenses, and this one is worn on the eye.";
  }
  if (!report.verdict) {
    return "No verdict: nothing says what was ordered; give --sphere, --cylinder, --axis, --add, --prism.";
  }
  const lenses::Verdict& verdict = *report.verdict;
  return verdict.standard + ", tolerances for " + name(verdict.lens_class) + ", against the " +
         (verdict.against_compensated ? "compensated (verification) power" : "order") + ": " +
         (verdict.pass() ? "all passed" : "NOT all passed");
}

std::string measure_table(const MeasureReport& report) {
  std::string out = first_line(report);
  out += "\npoint     on stop    x mm    y mm   sphere  cylinder   axis   prism  base   (D; TABO degrees; pd)\n";
  for (const lenses::PointReading& point : report.readings.points) {
    out += reading_line(report, point);
  }
  if (report.readings.addition) {
    out += std::string("addition  ") + name(report.readings.addition_side) + "  " +
           signed_number(report.readings.addition, 2) + " D\n";
  }
  out += '\n';
  out += verdict_line(report);
  out += '\n';
  if (report.verdict) {
    out += "tolerance           measured   target  difference   limit\n";
    for (const lenses::Check& check : report.verdict->checks) {
      out += check_line(check);
    }
  }
  return out;
}

std::string measure_json(const MeasureReport& report) {
  ordered_json j{{"version", 1},
                 {"lens", report.source},
                 {"side", report.side == lenses::Side::right ? "right" : "left"},
                 {"class", name(report.lens_class)},
                 {"index", report.lens.index},
                 {"cylinder_form", report.form == lenses::CylinderForm::minus ? "minus" : "plus"}};
  const auto thickness_mm = [](std::optional<double> metres) {
    return metres ? ordered_json(1e3 * *metres) : ordered_json();
  };
  j["thickness_mm"] = {{"centre", thickness_mm(report.centre_thickness)},
                       {"edge_least", report.edge ? thickness_mm(report.edge->least.thickness) : ordered_json()},
                       {"edge_least_at", report.edge ? mm(report.edge->least.at) : ordered_json()},
                       {"edge_greatest", report.edge ? thickness_mm(report.edge->greatest.thickness) : ordered_json()},
                       {"edge_greatest_at", report.edge ? mm(report.edge->greatest.at) : ordered_json()}};
  j["readings"] = ordered_json::array();
  for (const lenses::PointReading& point : report.readings.points) {
    j["readings"].push_back(reading_json(report, point));
  }
  j["addition_D"] = number_or_null(report.readings.addition);
  j["addition_surface"] = report.readings.addition ? ordered_json(name(report.readings.addition_side)) : ordered_json();
  j["verdict"] = report.verdict ? verdict_json(*report.verdict) : ordered_json();
  // A file's name may be bytes that are not UTF-8.
  return j.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace app
