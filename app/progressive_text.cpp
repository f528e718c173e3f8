#include "app/progressive_text.hpp"

#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace app {
namespace {

using lenses::ProgressiveConfig;
using nlohmann::ordered_json;

constexpr double kMm = 1e3;

[[gnu::format(printf, 1, 2)]] std::string line(const char* form, ...) {
  std::array<char, 256> text{};
  va_list values;
  va_start(values, form);
  std::vsnprintf(text.data(), text.size(), form, values);
  va_end(values);
  return std::string(text.data()) + "\n";
}

// No "-0.00", and no digits that mean nothing.
double tidy(double value, double steps_per_unit) {
  return std::round(value * steps_per_unit) / steps_per_unit + 0.0;
}

const char* method_name(ProgressiveConfig::Method method) {
  return method == ProgressiveConfig::Method::closed_form ? "closed-form" : "variational";
}

double minkwitz_share(const lenses::ProgressiveReport& report) {
  return report.minkwitz_bound > 0.0 ? report.minkwitz_reached / report.minkwitz_bound : 0.0;
}

ordered_json mm(const glm::dvec2& p) {
  return {tidy(kMm * p.x, 1e3), tidy(kMm * p.y, 1e3)};
}

}  // namespace

std::string progressive_table(const ProgressiveRun& run) {
  const ProgressiveConfig& surface = run.request.surface;
  const lenses::ProgressiveLens& made = run.made;
  const lenses::ProgressiveReport& report = made.report;
  const bool front = surface.face == ProgressiveConfig::Face::front;
  std::string text;
  text += line("%s: %s lens, %s progressive on the %s, %.2f s", run.output.c_str(),
               surface.side == lenses::Side::right ? "right" : "left", method_name(surface.method),
               front ? "front" : "eye side", run.seconds);
  text += line("order          %+.2f D, addition %.2f D, corridor %.1f mm, inset %.1f mm, hardness %.2f",
               run.request.sphere, run.request.addition, kMm * surface.corridor_length, kMm * surface.inset,
               surface.hardness);
  text += line("lens           base curve %.2f D, index %.3f, diameter %.1f mm, centre %.2f mm, edge %.2f to %.2f mm",
               made.base_curve, made.lens.index, kMm * made.lens.diameter, kMm * made.lens.centre_thickness,
               kMm * made.thinnest_edge, kMm * made.thickest_edge);
  text += line("lensmeter      distance %+.2f D, addition %.2f D with the %s on its stop",
               tidy(made.distance_reading, 100.0), made.addition_reading, front ? "front" : "back");
  text += line("surface        distance %+.2f D, near %+.2f D, addition %.2f D: mean curvature times %s",
               report.distance_power, report.near_power, report.addition(), front ? "n - 1" : "1 - n");
  text +=
      line("corridor       85 %% of the addition %.1f mm below the fitting cross", kMm * report.corridor_to_85_percent);
  text += line("clear width    cylinder below   narrowest (at y)        at distance   at near");
  for (const lenses::ZoneWidth& zone : report.widths) {
    text += line("               %.2f D           %5.1f mm (%+5.1f mm)     %5.1f mm      %5.1f mm", zone.limit,
                 kMm * zone.narrowest, kMm * zone.narrowest_y, kMm * zone.at_distance, kMm * zone.at_near);
  }
  text += line("peak cylinder  %.2f D at (%.1f, %.1f) mm", report.peak_cylinder, kMm * report.peak_at.x,
               kMm * report.peak_at.y);
  text += line(
      "Minkwitz       beside the line at y %.1f mm cylinder grows by %.3f D/mm, %.1f %% of twice the rise of power",
      kMm * report.minkwitz_y, report.minkwitz_reached / kMm, 100.0 * minkwitz_share(report));
  return text;
}

std::string progressive_json(const ProgressiveRun& run) {
  const ProgressiveConfig& surface = run.request.surface;
  const lenses::ProgressiveLens& made = run.made;
  const lenses::ProgressiveReport& report = made.report;
  ordered_json widths = ordered_json::array();
  for (const lenses::ZoneWidth& zone : report.widths) {
    widths.push_back({{"cylinder_D", zone.limit},
                      {"narrowest_mm", tidy(kMm * zone.narrowest, 1e3)},
                      {"narrowest_y_mm", tidy(kMm * zone.narrowest_y, 1e3)},
                      {"at_distance_mm", tidy(kMm * zone.at_distance, 1e3)},
                      {"at_near_mm", tidy(kMm * zone.at_near, 1e3)}});
  }
  const ordered_json document = {
      {"output", run.output},
      {"method", method_name(surface.method)},
      {"surface", surface.face == ProgressiveConfig::Face::front ? "front" : "back"},
      {"side", surface.side == lenses::Side::right ? "right" : "left"},
      {"order",
       {{"distance_power_D", run.request.sphere},
        {"addition_D", run.request.addition},
        {"corridor_mm", tidy(kMm * surface.corridor_length, 1e6)},
        {"inset_mm", tidy(kMm * surface.inset, 1e6)},
        {"hardness", surface.hardness}}},
      {"lens",
       {{"index", made.lens.index},
        {"base_curve_D", made.base_curve},
        {"diameter_mm", tidy(kMm * made.lens.diameter, 1e6)},
        {"centre_thickness_mm", tidy(kMm * made.lens.centre_thickness, 1e6)},
        {"thinnest_edge_mm", tidy(kMm * made.thinnest_edge, 1e6)},
        {"thickest_edge_mm", tidy(kMm * made.thickest_edge, 1e6)}}},
      {"lensmeter", {{"distance_D", tidy(made.distance_reading, 1e6)}, {"addition_D", made.addition_reading}}},
      {"surface_power",
       {{"distance_D", report.distance_power}, {"near_D", report.near_power}, {"addition_D", report.addition()}}},
      {"corridor_to_85_percent_mm", tidy(kMm * report.corridor_to_85_percent, 1e3)},
      {"clear_widths", std::move(widths)},
      {"peak_cylinder_D", report.peak_cylinder},
      {"peak_at_mm", mm(report.peak_at)},
      {"minkwitz",
       {{"y_mm", tidy(kMm * report.minkwitz_y, 1e3)},
        {"bound_D_per_mm", report.minkwitz_bound / kMm},
        {"reached_D_per_mm", report.minkwitz_reached / kMm},
        {"ratio", minkwitz_share(report)}}},
      {"seconds", run.seconds}};
  return document.dump(2) + "\n";
}

}  // namespace app
