// The optics of lenses/gpu compiled as C++: lenses::f64 is the reference, lenses::f32 rounds as the GPU does.
// The same text is included by the shaders.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <span>

// NOLINTBEGIN(misc-definitions-in-headers)
namespace lenses::f64 {
using real = double;
using uint = unsigned int;
using glm::abs, glm::atan, glm::clamp, glm::cross, glm::dot, glm::inversesqrt, glm::ivec4, glm::max, glm::min,
    glm::normalize, glm::sqrt, glm::transpose;
using vec2 = glm::dvec2;
using vec3 = glm::dvec3;
using vec4 = glm::dvec4;
using mat2 = glm::dmat2;
using mat3 = glm::dmat3;
inline constexpr real kEpsilon = std::numeric_limits<real>::epsilon();
struct Table {
  std::span<const vec4> entries;
  [[nodiscard]] const vec4& at(int i) const { return entries[static_cast<std::size_t>(i)]; }
};
#include "lenses/gpu/optics.h"
}  // namespace lenses::f64

namespace lenses::f32 {
using real = float;
using uint = unsigned int;
using glm::abs, glm::atan, glm::clamp, glm::cross, glm::dot, glm::inversesqrt, glm::ivec4, glm::max, glm::min,
    glm::normalize, glm::sqrt, glm::transpose;
using vec2 = glm::vec2;
using vec3 = glm::vec3;
using vec4 = glm::vec4;
using mat2 = glm::mat2;
using mat3 = glm::mat3;
inline constexpr real kEpsilon = std::numeric_limits<real>::epsilon();
struct Table {
  std::span<const vec4> entries;
  [[nodiscard]] const vec4& at(int i) const { return entries[static_cast<std::size_t>(i)]; }
};
#include "lenses/gpu/optics.h"
}  // namespace lenses::f32
// NOLINTEND(misc-definitions-in-headers)
