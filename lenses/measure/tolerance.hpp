// Tolerances for spectacle lenses as data, and the verdict on a lens by them. They judge the lens against what a
// lensmeter should read; they do not judge what it is like to wear.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lenses/lens.hpp"
#include "lenses/measure/readings.hpp"

namespace lenses {

enum class LensClass { single_vision, multifocal, progressive };

[[nodiscard]] constexpr const char* name(LensClass lens_class) {
  return lens_class == LensClass::single_vision ? "single_vision"
         : lens_class == LensClass::multifocal  ? "multifocal"
                                                : "progressive";
}

// What is allowed up to and including a nominal value; of several bands the first that reaches it counts.
struct ToleranceBand {
  double up_to;  // magnitude of the nominal value, D
  double limit;  // of the deviation to either side; of the nominal value's magnitude where relative
  bool relative = false;
};

struct ToleranceStandard {
  std::string name;
  // One of each a LensClass. Sphere and cylinder are those of the minus cylinder form.
  std::span<const ToleranceBand> sphere[3], cylinder[3];
  std::span<const ToleranceBand> axis;      // by cylinder, degrees
  double axis_from = 0.0;                   // smaller cylinders (D) have no axis to judge
  std::span<const ToleranceBand> addition;  // by addition
  // At the prism point either the prism is right to within the first, or a point as near as the second has it.
  double prism_pd = 0.0, prism_point_m = 0.0;
  // Of a mounted pair: the same for the difference of the lenses' vertical prisms.
  double imbalance_pd = 0.0, imbalance_point_m = 0.0;
};

// The first is the default.
[[nodiscard]] std::span<const ToleranceStandard> tolerance_standards();
// By name, of which letters and digits count: "ansi-z80.1-2015" will do. Null: not known.
[[nodiscard]] const ToleranceStandard* find_standard(std::string_view name);

[[nodiscard]] double tolerance_limit(std::span<const ToleranceBand> bands, double nominal);

struct Check {
  std::string tolerance;           // sphere, cylinder, axis, addition, prism, vertical imbalance
  std::string unit;                // D, deg, pd
  std::optional<double> measured;  // none: the lens has no point where it could be read
  double target = 0.0;
  std::optional<double> difference;  // measured less target; of prism the length of the vectors' difference
  double limit = 0.0;
  bool pass = false;
};

struct Verdict {
  std::string standard;
  LensClass lens_class = LensClass::single_vision;
  bool against_compensated = false;  // else against the order itself
  std::vector<Check> checks;
  [[nodiscard]] bool pass() const;
};

// multifocal: a surface has a segment; progressive: it has none, but the lens has a near point.
[[nodiscard]] LensClass lens_class_of(const Lens& lens);

// Base up of this lens more than of the other, beside what their orders say. None where either has no order or no
// reading.
[[nodiscard]] std::optional<Check> vertical_imbalance(const ToleranceStandard& standard, const LensReadings& readings,
                                                      const std::optional<Order>& order, const LensReadings& other,
                                                      const std::optional<Order>& other_order);

// Against the compensated power where the order has one.
[[nodiscard]] Verdict judge(const ToleranceStandard& standard, LensClass lens_class, const LensReadings& readings,
                            const Order& order);

}  // namespace lenses
