// A surface as measured or tabulated: heights at points, and how finely they were written down.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace lenses {

// Which surface of a lens: the one toward the scene or the one toward the eye.
enum class Face { front, back };

struct SagSamples {
  std::vector<glm::dvec3> points;  // m, lens axes, z positive toward the eye
  double noise = 0.0;              // standard deviation of the heights' error, m: what their rounding leaves
};

}  // namespace lenses
