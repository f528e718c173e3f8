// Small scenes for pictures of defocus: layers of pattern at known distances, and lights brighter than paper.
#pragma once

#include <cstdint>
#include <random>

#include "tests/support/lit_scene.hpp"

namespace support {

inline constexpr double kNearLayer = 0.4, kFarLayer = 2.5;  // m in front of the wearer

// Boxes of many sizes on paper: edges of every contrast without a period.
inline std::int32_t add_box_pattern(render::Scene& scene, std::uint32_t seed, std::uint32_t size) {
  std::mt19937 random(seed);
  const auto number = [&] { return static_cast<std::uint32_t>(random()); };
  std::vector<glm::uvec4> texels(std::size_t{size} * size, glm::uvec4(235, 232, 222, 255));
  for (int box = 0; box < 300; ++box) {
    const std::uint32_t width = 4 + number() % 40, height = 4 + number() % 40;
    const std::uint32_t left = number() % size, top = number() % size;
    const glm::uvec4 shade(20 + number() % 220, 20 + number() % 220, 20 + number() % 220, 255);
    for (std::uint32_t y = top; y < std::min(top + height, size); ++y) {
      for (std::uint32_t x = left; x < std::min(left + width, size); ++x) texels[std::size_t{y} * size + x] = shade;
    }
  }
  return add_texture(scene, size, size,
                     [&](std::uint32_t x, std::uint32_t y) { return texels[std::size_t{y} * size + x]; });
}

inline render::Material patterned(std::int32_t texture, const glm::vec3& colour) {
  render::Material material = unlit(glm::vec4(colour, 1.0F));
  material.base_colour_texture.index = texture;
  return material;
}

inline void add_targets(render::Scene& scene) {
  scene.cameras = {{"start", {}}};
  scene.cameras.front().pose.position.x = -lenses::Wearer{}.pupillary_distance[0];  // the right eye at the origin
  scene.targets = {{"near", {0.0, 0.0, -kNearLayer}}, {"far", {0.0, 0.0, -kFarLayer}}};
}

// A patterned wall behind a window of patterned slats and a round leaf: every kind of depth edge.
inline render::Scene layered_scene() {
  render::Scene scene = dark_scene();
  const auto wall = add_material(scene, patterned(add_box_pattern(scene, 1, 512), glm::vec3(0.8F)));
  const auto slat = add_material(scene, patterned(add_box_pattern(scene, 2, 256), glm::vec3(0.75F, 0.5F, 0.25F)));
  const auto leaf = add_material(scene, unlit({0.05F, 0.2F, 0.06F, 1.0F}));
  const auto near = static_cast<float>(kNearLayer);
  add_wall(scene, wall, 0.0F, 0.0F, static_cast<float>(kFarLayer), 0.4F);
  add_square(scene, slat, {0.003F, -0.06F, -near}, {0.012F, 0.002F, 0}, {0.002F, 0.12F, 0});
  add_square(scene, slat, {-0.022F, -0.06F, -near}, {0.0015F, 0, 0}, {0.006F, 0.12F, 0});
  add_square(scene, slat, {-0.06F, -0.018F, -near - 0.01F}, {0.12F, 0.008F, 0}, {0, 0.006F, 0});
  add_ball(scene, leaf, {-0.01F, 0.012F, -near}, 0.007F, 24);
  add_targets(scene);
  return scene;
}

// Lamps of 4 to 25 times paper in front of a dim wall, some of them behind a card's edge.
inline render::Scene lamp_scene() {
  render::Scene scene = dark_scene();
  const auto wall = add_material(scene, patterned(add_box_pattern(scene, 3, 512), glm::vec3(0.1F, 0.12F, 0.2F)));
  const auto card = add_material(scene, patterned(add_box_pattern(scene, 4, 256), glm::vec3(0.6F)));
  add_wall(scene, wall, 0.0F, 0.0F, static_cast<float>(kFarLayer) + 0.5F, 0.5F);
  const auto far = static_cast<float>(kFarLayer);
  std::mt19937 random(5);
  const auto uniform = [&] { return static_cast<float>(random() % 1000) / 1000.0F; };
  for (int lamp = 0; lamp < 14; ++lamp) {
    const float radiance = 4.0F * std::pow(6.0F, uniform());
    const auto glow = add_material(
        scene, unlit({radiance, radiance * (0.5F + 0.5F * uniform()), radiance * (0.3F + 0.7F * uniform()), 1.0F}));
    const float x = 0.26F * (uniform() - 0.5F), y = 0.26F * (uniform() - 0.5F);
    add_ball(scene, glow, {x, y, -far}, 0.0015F + 0.002F * uniform(), 8);
  }
  add_square(scene, card, {0.006F, -0.04F, -static_cast<float>(kNearLayer)}, {0.04F, 0, 0}, {0.004F, 0.034F, 0});
  add_targets(scene);
  return scene;
}

}  // namespace support
