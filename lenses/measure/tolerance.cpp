#include "lenses/measure/tolerance.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "lenses/engine.hpp"
#include "lenses/measure/power.hpp"

namespace lenses {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kAny = std::numeric_limits<double>::infinity();
// No instrument reads so finely; a deviation that equals its limit must not fail by rounding.
constexpr double kRounding = 1e-7;

// ANSI Z80.1-2015, tables of distance power (single vision and multifocal; progressive addition), axis and addition.
constexpr ToleranceBand kAnsi2015Sphere[]{{6.50, 0.13}, {kAny, 0.02, true}};
constexpr ToleranceBand kAnsi2015Cylinder[]{{2.00, 0.13}, {4.50, 0.15}, {kAny, 0.04, true}};
constexpr ToleranceBand kAnsi2015ProgressiveSphere[]{{8.00, 0.16}, {kAny, 0.02, true}};
constexpr ToleranceBand kAnsi2015ProgressiveCylinder[]{{2.00, 0.16}, {3.50, 0.18}, {kAny, 0.05, true}};
constexpr ToleranceBand kAnsi2015Axis[]{{0.25, 14.0}, {0.50, 7.0}, {0.75, 5.0}, {1.50, 3.0}, {kAny, 2.0}};
constexpr ToleranceBand kAnsi2015Addition[]{{4.00, 0.12}, {kAny, 0.18}};

const ToleranceStandard kStandards[]{
    {.name = "ANSI Z80.1-2015",
     .sphere = {kAnsi2015Sphere, kAnsi2015Sphere, kAnsi2015ProgressiveSphere},
     .cylinder = {kAnsi2015Cylinder, kAnsi2015Cylinder, kAnsi2015ProgressiveCylinder},
     .axis = kAnsi2015Axis,
     .axis_from = 0.12,
     .addition = kAnsi2015Addition,
     .prism_pd = 0.33,
     .prism_point_m = 1e-3,
     .imbalance_pd = 0.33,
     .imbalance_point_m = 1e-3},
};

std::string letters_and_digits(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
      out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
  }
  return out;
}

Check checked(const char* tolerance, const char* unit, std::optional<double> measured, double target, double limit) {
  Check check{tolerance, unit, measured, target, std::nullopt, limit, false};
  if (measured) {
    check.difference = *measured - target;
    check.pass = std::abs(*check.difference) <= limit + kRounding;
  }
  return check;
}

// In degrees, the shorter way round.
Check checked_axis(std::optional<double> measured, double target, double limit) {
  Check check = checked("axis", "deg", measured, target, limit);
  if (measured) {
    check.difference = std::remainder(*measured - target, 180.0);
    check.pass = std::abs(*check.difference) <= limit + kRounding;
  }
  return check;
}

// By Prentice's rule (P = F c, c in cm) the prism is right at c = F^-1 P from the prism point; the nearest such point
// lies as far away as this, infinitely far where the power has no part along the deviation.
double centimetres_off(const glm::dvec3& power, const glm::dvec2& deviation) {
  const glm::dvec3 k = f64::principal(power);
  const glm::dvec2 along(std::cos(k.z), std::sin(k.z)), across(-along.y, along.x);
  const auto off = [](double prism, double dioptres) {
    return std::abs(prism) <= kRounding ? 0.0 : std::abs(prism / dioptres);
  };
  return std::hypot(off(dot(deviation, along), k.x), off(dot(deviation, across), k.y));
}

// What a point as far away as allowed may make up for, in prism dioptres.
double prism_limit(const ToleranceStandard& standard, const glm::dvec3& power, const glm::dvec2& deviation) {
  const double off = centimetres_off(power, deviation);
  const double per_centimetre = off > 0.0 ? glm::length(deviation) / off : 0.0;
  return std::max(standard.prism_pd, 100.0 * standard.prism_point_m * per_centimetre);
}

Check checked_prism(const ToleranceStandard& standard, const PointReading* point, const Prescription& target) {
  const glm::dvec2 wanted = prism_vector(target.prism);
  Check check{"prism", "pd", std::nullopt, glm::length(wanted), std::nullopt, standard.prism_pd, false};
  if (point != nullptr && point->reading.status == RayStatus::ok) {
    const glm::dvec2 deviation = point->reading.prism - wanted;
    check.measured = glm::length(point->reading.prism);
    check.difference = glm::length(deviation);
    check.limit = prism_limit(standard, point->reading.power, deviation);
    check.pass = *check.difference <= check.limit + kRounding;
  }
  return check;
}

const Prescription& target_of(const Order& order) {
  return order.compensated ? *order.compensated : order.ordered;
}

}  // namespace

std::span<const ToleranceStandard> tolerance_standards() {
  return kStandards;
}

const ToleranceStandard* find_standard(std::string_view name) {
  const std::string wanted = letters_and_digits(name);
  const auto found = std::ranges::find_if(
      kStandards, [&](const ToleranceStandard& standard) { return letters_and_digits(standard.name) == wanted; });
  return found == std::end(kStandards) ? nullptr : &*found;
}

double tolerance_limit(std::span<const ToleranceBand> bands, double nominal) {
  const double size = std::abs(nominal);
  const auto band = std::ranges::find_if(bands, [&](const ToleranceBand& b) { return size <= b.up_to + kRounding; });
  return band == bands.end() ? 0.0 : band->relative ? band->limit * size : band->limit;
}

bool Verdict::pass() const {
  return std::ranges::all_of(checks, &Check::pass);
}

LensClass lens_class_of(const Lens& lens) {
  if (std::holds_alternative<SegmentedSurface>(lens.front) || std::holds_alternative<SegmentedSurface>(lens.back)) {
    return LensClass::multifocal;
  }
  return lens.reference_points.near ? LensClass::progressive : LensClass::single_vision;
}

std::optional<Check> vertical_imbalance(const ToleranceStandard& standard, const LensReadings& readings,
                                        const std::optional<Order>& order, const LensReadings& other,
                                        const std::optional<Order>& other_order) {
  const PointReading* here = readings.find(ReferencePoint::prism, LensSide::back);
  const PointReading* there = other.find(ReferencePoint::prism, LensSide::back);
  const auto read = [](const PointReading* point) {
    return point != nullptr && point->reading.status == RayStatus::ok;
  };
  if (!order || !other_order || !read(here) || !read(there)) {
    return std::nullopt;
  }
  const double target = prism_vector(target_of(*order).prism).y - prism_vector(target_of(*other_order).prism).y;
  // Prentice's rule, in the weaker of the two vertical powers.
  const double power = std::min(std::abs(here->reading.power.z), std::abs(there->reading.power.z));
  const double limit = std::max(standard.imbalance_pd, 100.0 * standard.imbalance_point_m * power);
  return checked("vertical imbalance", "pd", here->reading.prism.y - there->reading.prism.y, target, limit);
}

Verdict judge(const ToleranceStandard& standard, LensClass lens_class, const LensReadings& readings,
              const Order& order) {
  const Prescription& target = target_of(order);
  Verdict verdict{standard.name, lens_class, order.compensated.has_value(), {}};
  const auto kind = static_cast<std::size_t>(lens_class);
  const Refraction wanted =
      sphere_cylinder(power_matrix({target.sphere, target.cylinder, target.axis}), CylinderForm::minus);
  const PointReading* distance = readings.find(ReferencePoint::distance, LensSide::back);
  std::optional<Refraction> measured;
  if (distance != nullptr && distance->reading.status == RayStatus::ok) {
    measured = sphere_cylinder(distance->reading.power, CylinderForm::minus);
  }
  const auto of = [&](double Refraction::*part, double unit) {
    return measured ? std::optional<double>((*measured).*part * unit) : std::nullopt;
  };
  verdict.checks.push_back(checked("sphere", "D", of(&Refraction::sphere, 1.0), wanted.sphere,
                                   tolerance_limit(standard.sphere[kind], wanted.sphere)));
  verdict.checks.push_back(checked("cylinder", "D", of(&Refraction::cylinder, 1.0), wanted.cylinder,
                                   tolerance_limit(standard.cylinder[kind], wanted.cylinder)));
  if (std::abs(wanted.cylinder) >= standard.axis_from - kRounding) {
    verdict.checks.push_back(checked_axis(of(&Refraction::axis, kDegrees), wanted.axis * kDegrees,
                                          tolerance_limit(standard.axis, wanted.cylinder)));
  }
  if (target.addition != 0.0) {
    verdict.checks.push_back(checked("addition", "D", readings.addition, target.addition,
                                     tolerance_limit(standard.addition, target.addition)));
  }
  verdict.checks.push_back(checked_prism(standard, readings.find(ReferencePoint::prism, LensSide::back), target));
  return verdict;
}

}  // namespace lenses
