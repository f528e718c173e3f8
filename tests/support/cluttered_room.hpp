// A closed room full of balls, of any number of triangles: something for a traversal to chew on.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "tests/support/scene_oracle.hpp"

namespace support {

inline void add_ball(render::Scene& scene, const glm::vec3& centre, float radius, int rings, std::uint32_t material) {
  const auto at = [&](int i, int j) {
    const float latitude = glm::pi<float>() * static_cast<float>(i) / static_cast<float>(rings);
    const float longitude = glm::pi<float>() * static_cast<float>(j) / static_cast<float>(rings);
    return centre + radius * glm::vec3(std::sin(latitude) * std::cos(longitude), std::cos(latitude),
                                       std::sin(latitude) * std::sin(longitude));
  };
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < 2 * rings; ++j) {
      if (i > 0) scene_oracle::add_triangle(scene, at(i, j), at(i, j + 1), at(i + 1, j + 1), material);
      if (i + 1 < rings) scene_oracle::add_triangle(scene, at(i, j), at(i + 1, j + 1), at(i + 1, j), material);
    }
  }
}

// 8 m x 3 m x 8 m around the origin at a standing eye's height, one directional light. `triangles` is met to within one
// ball.
inline render::Scene cluttered_room(std::uint32_t seed, std::size_t triangles) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(-1.0F, 1.0F);
  render::Scene scene;
  scene_oracle::add_box(scene, {-4.0F, -1.6F, -4.0F}, {8.0F, 3.0F, 8.0F}, 0);
  const int rings = triangles > 50000 ? 24 : 8;
  while (scene.triangles.size() < triangles) {
    const glm::vec3 centre(3.8F * unit(random), -1.4F + 1.2F * (unit(random) + 1.0F), 3.8F * unit(random));
    const float radius = 0.04F * std::pow(6.0F, 0.5F * (unit(random) + 1.0F));
    if (glm::length(centre) > radius + 0.3F) {
      add_ball(scene, centre, radius, rings, 1 + static_cast<std::uint32_t>(scene.triangles.size() % 7));
    }
  }
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const float hue = static_cast<float>(i) / static_cast<float>(scene.materials.size());
    scene.materials[i].base_colour = glm::vec4(0.4F + 0.5F * hue, 0.8F - 0.5F * hue, 0.6F, 1.0F);
  }
  render::Light sun;
  sun.type = render::Light::Type::directional;
  sun.direction = glm::normalize(glm::vec3(-0.4F, -0.8F, -0.45F));
  scene.lights = {sun};
  return scene;
}

}  // namespace support
