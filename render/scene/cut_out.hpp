// Holes of cut-out materials on the CPU: what shaders/alpha.glsl decides at a hit, from the texture's finest level.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "render/scene/scene.hpp"

namespace render {

class CutOuts {
 public:
  // Of the listed triangles, all of cut-out materials. Keeps a copy of what it needs.
  CutOuts(const Scene& scene, const std::vector<std::uint32_t>& triangles);

  // place: in the list; u, v: the hit's weights of corners 1 and 2.
  [[nodiscard]] bool is_hole(std::uint32_t place, float u, float v) const;

 private:
  struct Corner {
    glm::vec2 uv{0.0F};  // transformed, as the base colour's texture is sampled
    float alpha = 1.0F;  // the material's times the vertex's
  };
  struct Triangle {
    std::array<Corner, 3> corners;
    std::int32_t plane = -1;  // -1: no texture
    float cutoff = 0.5F;
  };
  struct Plane {
    int width = 0, height = 0;
    Texture::Wrap wrap_u = Texture::Wrap::repeat, wrap_v = Texture::Wrap::repeat;
    std::vector<std::uint8_t> alpha;

    [[nodiscard]] float sample(const glm::vec2& uv) const;  // linear between texels
  };

  std::vector<Triangle> triangles_;
  std::vector<Plane> planes_;
};

}  // namespace render
