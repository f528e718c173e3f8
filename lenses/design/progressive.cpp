#include "lenses/design/progressive.hpp"

#include <algorithm>
#include <cmath>

#include "lenses/bspline_field.hpp"
#include "lenses/design/height_field_solver.hpp"
#include "lenses/design/progressive_report.hpp"
#include "lenses/design/progressive_target.hpp"
#include "lenses/design/surface_power.hpp"

namespace lenses {
namespace {

// Steps until nothing moves any more; each also corrects what is asked for by what was missing at the two points.
BsplineHeightField variational_progressive(const ProgressiveConfig& config, const DesignProgress& progress) {
  constexpr int kMostSteps = 20, kUsualSteps = 10;
  constexpr double kSettledPower = 1e-3, kSettledCost = 1e-4;  // D, share of the cost
  const double factor = config.power_per_curvature();
  HeightFieldSolver solver(closed_form_progressive(config), factor);
  ProgressiveTarget target(config);
  const auto power = [&](const glm::dvec2& p) {
    return factor * surface_curvature(HeightFieldReader(solver.surface()).at(p)).mean;
  };
  for (int i = 1; i <= kMostSteps; ++i) {
    for (DesignSite& site : solver.sites()) {
      const DesignTarget wanted = target.at(site.place);
      site.power = wanted.power;
      site.power_weight = wanted.power_weight;
      site.cylinder_weight = wanted.cylinder_weight;
    }
    const double gained = solver.step();
    const double distance = power({0.0, config.distance_point}), addition = power(config.near_point()) - distance;
    const double missing_distance = config.distance_power - distance, missing_addition = config.addition - addition;
    target.ask_for_more(missing_distance, missing_addition);
    if (progress) progress(std::min(0.95, static_cast<double>(i) / kUsualSteps));
    if (gained < kSettledCost && std::hypot(missing_distance, missing_addition) < kSettledPower) break;
  }
  return solver.surface();
}

}  // namespace

ProgressiveDesign design_progressive(const ProgressiveConfig& config, const DesignProgress& progress) {
  config.validate();
  // A left lens is the mirror image of a right one, to the last digit.
  ProgressiveConfig right = config;
  right.side = Side::right;
  ProgressiveDesign design{config.method == ProgressiveConfig::Method::closed_form
                               ? closed_form_progressive(right)
                               : variational_progressive(right, progress),
                           {}};
  if (config.side == Side::left) design.surface = mirrored(design.surface);
  design.report = report_progressive(design.surface, config);
  if (progress) progress(1.0);
  return design;
}

}  // namespace lenses
