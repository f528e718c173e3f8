// A single-vision lens of ordinary shape.
#pragma once

#include "lenses/lens.hpp"

namespace support {

// Of this back vertex power, D; its front 10 D for a plus lens, 3 D for a minus lens.
inline lenses::Lens meniscus(double power) {
  lenses::Lens lens;
  lens.index = 1.5;
  lens.centre_thickness = power > 0.0 ? 0.006 : 0.0015;
  lens.diameter = 0.07;
  const double front = power > 0.0 ? 10.0 : 3.0;
  const double at_back = front / (1.0 - lens.centre_thickness / lens.index * front);
  lens.front = lenses::Sphere{front / 0.5};
  lens.back = lenses::Sphere{(at_back - power) / 0.5};
  return lens;
}

}  // namespace support
