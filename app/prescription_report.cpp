#include "app/prescription_report.hpp"

#include <array>
#include <cmath>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

namespace app {
namespace {

using nlohmann::ordered_json;

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kMm = 1e3;

std::string fixed(double value, int digits) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(digits) << value;
  const std::string shown = text.str();
  // No "-0.00".
  return shown.find_first_not_of("-0.") == std::string::npos && shown.front() == '-' ? shown.substr(1) : shown;
}

std::string signed_dioptres(double value) {
  const std::string text = fixed(value, 2);
  return text.front() == '-' ? text : "+" + text;
}

std::string power_row(const std::string& name, const lenses::Prescription& p) {
  std::ostringstream row;
  row << std::left << std::setw(12) << name << std::right << std::setw(9) << signed_dioptres(p.sphere) << std::setw(10)
      << signed_dioptres(p.cylinder) << std::setw(7) << (p.cylinder == 0.0 ? "-" : fixed(p.axis * kDegrees, 1))
      << std::setw(7) << (p.addition == 0.0 ? "-" : fixed(p.addition, 2)) << "  ";
  for (const lenses::Prism& prism : p.prism) {
    row << " " << fixed(prism.magnitude, 2) << "@" << fixed(prism.base * kDegrees, 1);
  }
  row << (p.prism.empty() ? " -" : "") << "\n";
  return row.str();
}

std::string radius(double curvature) {
  return curvature == 0.0 ? "flat" : fixed(kMm / curvature, 2);
}

struct SurfaceWords {
  std::string operator()(const lenses::Plane&) const { return "plane"; }
  std::string operator()(const lenses::Sphere& s) const { return "sphere, radius " + radius(s.curvature) + " mm"; }
  std::string operator()(const lenses::Conic& s) const {
    return "conic, radius " + radius(s.curvature) + " mm, conic constant " + fixed(s.conic_constant, 2);
  }
  std::string operator()(const lenses::Torus& s) const {
    return "torus, radii " + radius(s.curvature_u) + " and " + radius(s.curvature_v) + " mm, the first at " +
           fixed(180.0 - s.axis * kDegrees, 1) + " deg (TABO)";
  }
  std::string operator()(const lenses::BsplineHeightField& s) const {
    return "progressive, " + std::to_string(s.count_x()) + " x " + std::to_string(s.count_y()) + " control points";
  }
  std::string operator()(const lenses::BsplineSurface& s) const {
    return "free form, " + std::to_string(s.count_u()) + " x " + std::to_string(s.count_v()) + " control points";
  }
  std::string operator()(const lenses::SegmentedSurface& s) const {
    return std::visit(*this, s.base) + "; segment " + std::visit(*this, s.segment);
  }
};

std::optional<double> grams(const PrescriptionReport& report) {
  constexpr double kGramsPerKilogram = 1e3;
  return report.density ? std::optional(*report.density * report.designed.volume * kGramsPerKilogram) : std::nullopt;
}

ordered_json power_json(const lenses::Prescription& p) {
  ordered_json prisms = ordered_json::array();
  for (const lenses::Prism& prism : p.prism) {
    prisms.push_back({{"magnitude", prism.magnitude}, {"base", prism.base * kDegrees}});
  }
  return {{"sphere", p.sphere},
          {"cylinder", p.cylinder},
          {"axis", p.cylinder == 0.0 ? ordered_json(nullptr) : ordered_json(p.axis * kDegrees)},
          {"add", p.addition},
          {"prism", std::move(prisms)}};
}

}  // namespace

std::string to_table(const PrescriptionReport& report) {
  const lenses::DesignedLens& d = report.designed;
  std::ostringstream out;
  out << report.output << ": index " << fixed(d.lens.index, 3) << ", Abbe number " << fixed(d.lens.abbe, 0) << "\n\n"
      << "            sphere D  cylinder   axis    add   prism@base\n"
      << power_row("ordered", d.lens.order->ordered) << power_row("compensated", d.verification)
      << (d.worn ? power_row("as worn", *d.worn) : "as worn     no light passes in this fit\n") << "\nfront       "
      << std::visit(SurfaceWords{}, d.lens.front) << "\nback        " << std::visit(SurfaceWords{}, d.lens.back)
      << "\n";
  if (d.base_curve > 0.0) {
    out << "base curve  " << fixed(d.base_curve, 2) << " D\n";
  }
  out << "thickness   centre " << fixed(d.lens.centre_thickness * kMm, 2) << " mm, edge "
      << fixed(d.thinnest_edge * kMm, 2) << " to " << fixed(d.thickest_edge * kMm, 2) << " mm\n"
      << "diameter    " << fixed(d.lens.diameter * kMm, 1) << " mm\n";
  if (const auto weight = grams(report)) {
    out << "weight      " << fixed(*weight, *weight < 1.0 ? 3 : 1) << " g\n";
  }
  return out.str();
}

std::string to_json(const PrescriptionReport& report) {
  const lenses::DesignedLens& d = report.designed;
  const auto weight = grams(report);
  const ordered_json document = {
      {"output", report.output},
      {"ordered", power_json(d.lens.order->ordered)},
      {"compensated", power_json(d.verification)},
      {"as_worn", d.worn ? power_json(*d.worn) : ordered_json(nullptr)},
      {"base_curve_D", d.base_curve > 0.0 ? ordered_json(d.base_curve) : ordered_json(nullptr)},
      {"index", d.lens.index},
      {"centre_thickness_mm", d.lens.centre_thickness * kMm},
      {"edge_thickness_mm", ordered_json::array({d.thinnest_edge * kMm, d.thickest_edge * kMm})},
      {"diameter_mm", d.lens.diameter * kMm},
      {"weight_g", weight ? ordered_json(*weight) : ordered_json(nullptr)}};
  return document.dump(2) + "\n";
}

}  // namespace app
