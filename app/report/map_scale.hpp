// The range of a map's colours and the distance of its isolines.
#pragma once

#include <vector>

namespace app {

struct MapScale {
  double low = 0.0, high = 1.0, step = 0.25;  // of the isolines
};

// Round numbers around the values (99 of 100 of them; the rest takes the end's colour), isolines `least_step` apart or,
// where that would make more than about 24 of them, a rounder number of steps. At least four steps high.
[[nodiscard]] MapScale map_scale(std::vector<double> values, double least_step);

}  // namespace app
