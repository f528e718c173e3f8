// The numbers of a measured lens as CSV. Lengths in mm, powers in D, prism in prism dioptres, axes and bases in TABO
// degrees, gaze in degrees; an empty cell is a value that does not exist.
#pragma once

#include <string>

#include "app/measure/measure_report.hpp"
#include "lenses/measure/lens_map.hpp"
#include "lenses/measure/worn_map.hpp"

namespace app {

[[nodiscard]] std::string readings_csv(const MeasureReport& report);
[[nodiscard]] std::string verdict_csv(const lenses::Verdict& verdict);
[[nodiscard]] std::string lens_map_csv(const lenses::LensMap& map, lenses::CylinderForm form);
// unwanted: astigmatism of the difference to the report's ordered_power.
[[nodiscard]] std::string worn_map_csv(const lenses::WornMap& map, const MeasureReport& report);

}  // namespace app
