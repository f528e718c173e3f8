// Evenly spaced samples over a rectangle, row after row from the lowest up.
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <stdexcept>

namespace lenses {

struct Grid {
  glm::dvec2 low{0.0}, high{0.0};  // of the outermost samples
  std::size_t columns = 2, rows = 2;

  [[nodiscard]] std::size_t count() const { return columns * rows; }
  [[nodiscard]] glm::dvec2 step() const {
    return (high - low) / glm::dvec2(static_cast<double>(columns - 1), static_cast<double>(rows - 1));
  }
  [[nodiscard]] glm::dvec2 at(std::size_t index) const {
    return low + step() * glm::dvec2(static_cast<double>(index % columns), static_cast<double>(index / columns));
  }
};

// A square of `points` samples each way about the origin; `points` at least 2.
[[nodiscard]] inline Grid square_grid(double half_width, std::size_t points) {
  if (points < 2) {
    throw std::invalid_argument("a map needs at least 2 samples each way");
  }
  return {glm::dvec2(-half_width), glm::dvec2(half_width), points, points};
}

}  // namespace lenses
