// A measured lens as a page beside its pictures.
#pragma once

#include <span>
#include <string>

#include "app/measure/measure_pictures.hpp"
#include "app/measure/measure_report.hpp"

namespace app {

// What the as-worn maps were computed for.
struct WornSetting {
  double working_distance = 0.0;             // m
  double far_pitch = 0.0, near_pitch = 0.0;  // radians
  double vertex_sphere = 0.0;                // radius, m
};

[[nodiscard]] std::string measure_page(const MeasureReport& report, const WornSetting& worn,
                                       std::span<const NamedPicture> pictures);

}  // namespace app
