#include "lenses/measure/lens_map.hpp"

namespace lenses {

LensMap lens_map(const Lens& lens, const Lensmeter& lensmeter, std::size_t points, const Progress& progress) {
  LensMap map{square_grid(0.5 * lens.diameter, points), {}};
  map.readings.reserve(map.grid.count());
  const double reach = 0.25 * lens.diameter * lens.diameter;
  for (std::size_t i = 0; i < map.grid.count(); ++i) {
    const glm::dvec2 at = map.grid.at(i);
    LensMapReading reading;
    reading.back = lensmeter.read(LensSide::back, at);
    if (dot(at, at) <= reach) {
      reading.thickness = lensmeter.thickness(at).value_or(reading.thickness);
    }
    map.readings.push_back(reading);
    if (progress && i % map.grid.columns == 0) {
      progress(static_cast<double>(i) / static_cast<double>(map.grid.count()));
    }
  }
  return map;
}

}  // namespace lenses
