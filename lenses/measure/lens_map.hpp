// A lens as a lensmeter finds it all over: at every sample the beam is normal to the back surface there.
#pragma once

#include <functional>
#include <limits>
#include <vector>

#include "lenses/lens.hpp"
#include "lenses/measure/grid.hpp"
#include "lenses/measure/lensmeter.hpp"

namespace lenses {

// Told how much of the work is done, 0 to 1.
using Progress = std::function<void(double done)>;

struct LensMapReading {
  LensmeterReading back;
  double thickness = std::numeric_limits<double>::quiet_NaN();  // m, along the lens axis; none outside the blank
};

struct LensMap {
  Grid grid;  // m, lens axes
  std::vector<LensMapReading> readings;
};

[[nodiscard]] LensMap lens_map(const Lens& lens, const Lensmeter& lensmeter, std::size_t points,
                               const Progress& progress = {});

}  // namespace lenses
