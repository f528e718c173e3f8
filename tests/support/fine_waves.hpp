// The same hills as ever finer meshes: what grows is the number of triangles, not what there is to see.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "render/scene/scene.hpp"

namespace support {

// 20 m by 20 m below the origin, of squares of two triangles; `triangles` is met to within a row of them.
inline render::Scene fine_waves(std::size_t triangles) {
  const auto sides = static_cast<std::uint32_t>(std::lround(std::sqrt(static_cast<double>(triangles) / 2.0)));
  render::Scene scene;
  scene.source = "waves";
  scene.materials.emplace_back();
  scene.materials[0].double_sided = true;
  scene.vertices.reserve(std::size_t{sides + 1} * (sides + 1));
  for (std::uint32_t j = 0; j <= sides; ++j) {
    for (std::uint32_t i = 0; i <= sides; ++i) {
      const float x = 20.0F * static_cast<float>(i) / static_cast<float>(sides) - 10.0F;
      const float z = 20.0F * static_cast<float>(j) / static_cast<float>(sides) - 10.0F;
      const float y = std::sin(x) * std::cos(1.3F * z) + 0.1F * std::sin(9.0F * x) * std::sin(11.0F * z);
      scene.vertices.push_back({{x, y - 2.5F, z}, {0, 1, 0}, {x, z}});
    }
  }
  scene.triangles.reserve(std::size_t{2} * sides * sides);
  for (std::uint32_t j = 0; j < sides; ++j) {
    for (std::uint32_t i = 0; i < sides; ++i) {
      const std::uint32_t a = j * (sides + 1) + i, b = a + sides + 1;
      scene.triangles.emplace_back(a, b, b + 1);
      scene.triangles.emplace_back(a, b + 1, a + 1);
    }
  }
  scene.triangle_material.assign(scene.triangles.size(), 0);
  return scene;
}

}  // namespace support
