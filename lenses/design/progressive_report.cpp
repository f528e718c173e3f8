#include "lenses/design/progressive_report.hpp"

#include <algorithm>
#include <cmath>

#include "lenses/bspline_field.hpp"
#include "lenses/design/surface_power.hpp"

namespace lenses {
namespace {

constexpr double kFine = 5e-5;  // steps along the corridor and across it, m

class Surveyor {
 public:
  Surveyor(const BsplineHeightField& surface, const ProgressiveConfig& config)
      : reader_(surface), config_(config), factor_(config.power_per_curvature()) {}

  [[nodiscard]] SurfaceCurvature curvature(const glm::dvec2& p) const { return surface_curvature(reader_.at(p)); }
  [[nodiscard]] double power(const glm::dvec2& p) const { return factor_ * curvature(p).mean; }
  [[nodiscard]] double cylinder(const glm::dvec2& p) const { return std::abs(factor_) * curvature(p).difference(); }

  // The line from the fitting cross to the near point, and straight up and down beyond.
  [[nodiscard]] double line_x(double y) const {
    const glm::dvec2 near = config_.near_point();
    const double t = (config_.fitting_cross - y) / (config_.fitting_cross - near.y);
    return near.x * std::clamp(t, 0.0, 1.0);
  }

  // Of the stretch at height y, about its clearest place near the line, where the cylinder stays below the limit.
  [[nodiscard]] double width(double y, double limit) const {
    constexpr double kSearch = 0.002;
    double centre = line_x(y), least = cylinder({centre, y});
    for (double x = line_x(y) - kSearch; x <= line_x(y) + kSearch; x += kFine) {
      const double here = cylinder({x, y});
      if (here < least) {
        least = here;
        centre = x;
      }
    }
    if (least >= limit) return 0.0;
    return edge(centre, y, 1.0, limit) + edge(centre, y, -1.0, limit);
  }

 private:
  // How far from x the limit or the lens's edge is.
  [[nodiscard]] double edge(double x, double y, double direction, double limit) const {
    const double rim = std::sqrt(std::max(0.0, 0.25 * config_.diameter * config_.diameter - y * y));
    double far = 0.0, last = cylinder({x, y});
    while (std::abs(x + direction * (far + kFine)) < rim) {
      const double next = cylinder({x + direction * (far + kFine), y});
      if (next >= limit) return far + kFine * (limit - last) / (next - last);
      last = next;
      far += kFine;
    }
    return far;
  }

  HeightFieldReader reader_;
  const ProgressiveConfig& config_;
  double factor_;
};

ZoneWidth zone_width(const Surveyor& surveyor, const ProgressiveConfig& config, double limit) {
  ZoneWidth zone;
  zone.limit = limit;
  zone.at_distance = surveyor.width(config.distance_point, limit);
  zone.at_near = surveyor.width(config.near_point().y, limit);
  zone.narrowest = config.diameter;
  constexpr double kStep = 2.5e-4;
  for (double y = config.fitting_cross; y >= config.near_point().y; y -= kStep) {
    const double width = surveyor.width(y, limit);
    if (width < zone.narrowest) {
      zone.narrowest = width;
      zone.narrowest_y = y;
    }
  }
  return zone;
}

// Down the line: where the addition is reached, and where power changes fastest.
void follow_line(const Surveyor& surveyor, const ProgressiveConfig& config, ProgressiveReport& report) {
  const double wanted = report.distance_power + 0.85 * config.addition;
  const auto on_line = [&](double y) { return glm::dvec2(surveyor.line_x(y), y); };
  constexpr double kReach = 7.5e-4;  // of the differences: half a cell of a net of 50; the corridor is 8 mm or longer
  double length = 0.0;
  for (double y = config.fitting_cross; y > -0.45 * config.diameter; y -= kFine) {
    const glm::dvec2 here = on_line(y), next = on_line(y - kFine);
    length += glm::length(next - here);
    if (report.corridor_to_85_percent == 0.0 && surveyor.power(next) >= wanted) report.corridor_to_85_percent = length;
    if (y < config.near_point().y + kReach) continue;
    const glm::dvec2 along = glm::normalize(next - here), across(-along.y, along.x);
    const double rise =
        (surveyor.power(here + kReach * along) - surveyor.power(here - kReach * along)) / (2.0 * kReach);
    if (2.0 * rise <= report.minkwitz_bound) continue;
    const SurfaceCurvature a = surveyor.curvature(here - kReach * across),
                           b = surveyor.curvature(here + kReach * across);
    report.minkwitz_bound = 2.0 * rise;
    report.minkwitz_reached =
        std::abs(config.power_per_curvature()) * std::hypot(b.plus - a.plus, b.cross - a.cross) / (2.0 * kReach);
    report.minkwitz_y = y;
  }
}

}  // namespace

ProgressiveReport report_progressive(const BsplineHeightField& surface, const ProgressiveConfig& config) {
  const Surveyor surveyor(surface, config);
  ProgressiveReport report;
  report.distance_power = surveyor.power({0.0, config.distance_point});
  report.near_power = surveyor.power(config.near_point());
  constexpr std::array<double, 3> kLimits{0.25, 0.5, 1.0};
  for (std::size_t i = 0; i < kLimits.size(); ++i) report.widths[i] = zone_width(surveyor, config, kLimits[i]);
  follow_line(surveyor, config, report);
  constexpr double kCoarse = 5e-4;
  const double radius = 0.5 * config.diameter;
  for (double x = -radius; x <= radius; x += kCoarse) {
    for (double y = -radius; y <= radius; y += kCoarse) {
      if (x * x + y * y > radius * radius) continue;
      const double here = surveyor.cylinder({x, y});
      if (here > report.peak_cylinder) {
        report.peak_cylinder = here;
        report.peak_at = {x, y};
      }
    }
  }
  return report;
}

}  // namespace lenses
