// A lens measured: readings, thickness and verdict, in print and as JSON.
#pragma once

#include <optional>
#include <string>

#include "lenses/lens.hpp"
#include "lenses/measure/power.hpp"
#include "lenses/measure/readings.hpp"
#include "lenses/measure/thickness.hpp"
#include "lenses/measure/tolerance.hpp"

namespace app {

struct MeasureReport {
  std::string source;  // the file, and the side where it holds a pair
  lenses::Lens lens;
  lenses::Side side = lenses::Side::right;
  lenses::CylinderForm form = lenses::CylinderForm::minus;
  lenses::LensClass lens_class = lenses::LensClass::single_vision;
  lenses::LensReadings readings;
  std::optional<double> centre_thickness;  // m, at the lens's origin
  std::optional<lenses::EdgeThickness> edge;
  std::optional<lenses::Verdict> verdict;  // none: nothing was ordered, or it is a contact lens
};

// Throws std::invalid_argument for a lens that cannot be modelled. `standard` counts only where something was ordered;
// `other` is the pair's other lens, for what is judged of a pair.
[[nodiscard]] MeasureReport measure_lens(const std::string& source, const lenses::Lens& lens, lenses::Side side,
                                         lenses::CylinderForm form, lenses::LensClass lens_class,
                                         const lenses::ToleranceStandard& standard,
                                         const std::optional<lenses::Lens>& other = std::nullopt);

// What was ordered for distance, as a power matrix; zero where nothing was. Astigmatism beyond it is unwanted.
[[nodiscard]] glm::dvec3 ordered_power(const MeasureReport& report);

// What was judged against, in words.
[[nodiscard]] std::string verdict_line(const MeasureReport& report);

[[nodiscard]] std::string measure_table(const MeasureReport& report);
[[nodiscard]] std::string measure_json(const MeasureReport& report);

// TABO degrees of a reading's axis and base; none where the cylinder or the prism would print as 0.00.
[[nodiscard]] std::optional<double> axis_degrees(const lenses::Refraction& refraction);
[[nodiscard]] std::optional<double> base_degrees(const lenses::Prism& prism);

}  // namespace app
