// A soft contact lens of ordinary shape.
#pragma once

#include "lenses/lens.hpp"

namespace support {

inline lenses::Lens contact_lens() {
  lenses::Lens lens;
  lens.index = 1.43;
  lens.centre_thickness = 0.0001;
  lens.diameter = 0.014;
  lens.front = lenses::Sphere{1.0 / 0.0089};
  lens.back = lenses::Sphere{1.0 / 0.0086};
  lens.fit.vertex_distance = 0.0;
  lens.attached_to = lenses::Lens::AttachedTo::eye;
  return lens;
}

}  // namespace support
