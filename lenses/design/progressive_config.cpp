// A progressive design's configuration: its limits, and its layout as the sphere family's.
#include <algorithm>
#include <cmath>
#include <string>

#include "lenses/bspline_field.hpp"
#include "lenses/design/progressive.hpp"
#include "tracking/input_error.hpp"

namespace lenses {
namespace {

// Beyond this sine of the incidence on its own spheres a surface is no lens any more.
constexpr double kSteepest = 0.8;

std::string text(double value) {
  std::string digits = std::to_string(value);
  digits.erase(digits.find_last_not_of('0') + 1);
  if (digits.back() == '.') digits.pop_back();
  return digits;
}

void require(const char* field, double value, double lo, double hi, double unit, const std::string& unit_name) {
  const double rounding = 1e-12 * hi;  // 18 mm read as 18 * 1e-3 m
  if (value >= lo - rounding && value <= hi + rounding) return;
  throw tracking::InputError("progressive", field,
                             "is " + text(value / unit) + unit_name + "; " + text(lo / unit) + " to " +
                                 text(hi / unit) + unit_name + " is allowed");
}

}  // namespace

void ProgressiveConfig::validate() const {
  constexpr double kMm = 1e-3;
  require("addition", addition, kLeastAddition, kMostAddition, 1.0, " D");
  require("corridor_length", corridor_length, 0.008, 0.018, kMm, " mm");
  require("inset", inset, 0.0, 0.005, kMm, " mm");
  require("hardness", hardness, 0.0, 1.0, 1.0, "");
  require("index", index, 1.4, 2.0, 1.0, "");
  require("diameter", diameter, 0.04, 0.08, kMm, " mm");
  require("fitting_cross", fitting_cross, 0.0, 0.006, kMm, " mm");
  require("distance_point", distance_point, fitting_cross, 0.012, kMm, " mm");
  require("distance_power", distance_power, -25.0, 25.0, 1.0, " D");
  require("grid", static_cast<double>(grid), 24.0, 100.0, 1.0, "");
  if (diameter > widest()) {
    throw tracking::InputError("progressive", "diameter",
                               "is " + text(diameter / kMm) + " mm; at most " + text(std::floor(widest() / kMm)) +
                                   " mm fits on a surface of this power, a flatter one allows more");
  }
}

double ProgressiveConfig::widest() const {
  const double steepest = std::max(std::abs(distance_power), std::abs(distance_power + addition)) / (index - 1.0);
  return std::max(0.0, 2.0 * (kSteepest / steepest - kNetMargin));
}

ProgressiveFamilyConfig family_config(const ProgressiveConfig& config) {
  // The rise begins a little above the fitting cross; the poles lie beyond its ends, distance 10 mm, near 5 mm.
  constexpr double kRiseAbove = 0.001, kDistancePole = 0.010, kNearPole = 0.005;
  const double length = std::hypot(config.corridor_length, config.inset);
  ProgressiveFamilyConfig family;
  family.distance_power = config.distance_power;
  family.addition = config.addition;
  family.power_per_curvature = config.power_per_curvature();
  family.rise_start = -config.fitting_cross - kRiseAbove;
  family.rise_length = length + kRiseAbove;
  family.distance_pole = family.rise_start - kDistancePole;
  family.near_pole = -config.fitting_cross + length + kNearPole;
  family.inset = std::atan2(config.inset, config.corridor_length);
  family.fitting_cross = config.fitting_cross;
  return family;
}

BsplineHeightField closed_form_progressive(const ProgressiveConfig& config) {
  config.validate();
  const ProgressiveFamily family(family_config(config));
  const auto height = [&](const glm::dvec2& p) { return family.height(config.nose_x() * p.x, p.y); };
  // In the corners of the square a steep family's spheres may end: from a circle on, the height goes on along each
  // radius with its slope and bend there.
  const double strongest = std::max(std::abs(config.distance_power), std::abs(config.distance_power + config.addition));
  const double limit = kSteepest * std::abs(config.power_per_curvature()) / strongest;
  const auto continued = [&](const glm::dvec2& p) {
    const double r = glm::length(p);
    if (r <= limit) return height(p);
    constexpr double kStep = 1e-4;
    const glm::dvec2 out = p / r;
    const double z0 = height(limit * out), z1 = height((limit - kStep) * out), z2 = height((limit - 2 * kStep) * out);
    const double bend = (z0 - 2.0 * z1 + z2) / (kStep * kStep), slope = (z0 - z1) / kStep + 0.5 * bend * kStep;
    return z0 + (r - limit) * (slope + 0.5 * bend * (r - limit));
  };
  constexpr double kStep = 1e-5;
  const double z = height({0.0, 0.0});
  const glm::dvec2 slope(0.5 * (height({kStep, 0.0}) - height({-kStep, 0.0})) / kStep,
                         0.5 * (height({0.0, kStep}) - height({0.0, -kStep})) / kStep);
  return fit_height_field(
      [&](double x, double y) {
        return continued({x, y}) - z - slope.x * x - slope.y * y;
      },
      config.grid, config.half_width());
}

}  // namespace lenses
