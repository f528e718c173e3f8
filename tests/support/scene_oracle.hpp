// Procedural scenes, rays, and the shader's BVH traversal compiled as C++: render/shaders/traverse_bvh4.glsl itself,
// with GLM's types and the two texel buffers replaced by vectors.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>
#include <optional>
#include <random>
#include <vector>

#include "render/scene/bvh.hpp"
#include "render/scene/gpu/bvh_layout.h"
#include "render/scene/scene.hpp"

namespace scene_oracle {

namespace shader {
using namespace glm;     // NOLINT(google-build-using-namespace): the text below is GLSL
using namespace render;  // NOLINT(google-build-using-namespace)
using glm::uint;

inline thread_local const uvec4* bvh_nodes = nullptr;
inline thread_local const vec4* bvh_triangles = nullptr;
inline thread_local std::size_t fetches = 0;  // a traversal's cost on any machine
inline uvec4 texelFetch(const uvec4* buffer, int texel) {
  ++fetches;
  return buffer[texel];
}
inline vec4 texelFetch(const vec4* buffer, int texel) {
  ++fetches;
  return buffer[texel];
}

#include "render/shaders/traverse_bvh4.glsl"
}  // namespace shader

struct Hit {
  float t;
  std::uint32_t leaf_triangle;  // in leaf order
  std::uint32_t triangle;       // index into Scene::triangles
  std::uint32_t material;
  float u, v;
};

inline std::optional<Hit> trace(const render::Bvh4& bvh, const glm::vec3& origin, const glm::vec3& direction,
                                float t_max = 1e30F, bool any_hit = false) {
  shader::bvh_nodes = bvh.nodes.data();
  shader::bvh_triangles = bvh.triangles.data();
  const shader::Hit hit = shader::traverse_bvh4(origin, direction, t_max, any_hit);
  if (hit.triangle == shader::kNoTriangle) return std::nullopt;
  const glm::vec4 second = bvh.triangles[hit.triangle * render::kBvhTriangleTexels + 1];
  return Hit{hit.t, hit.triangle, glm::floatBitsToUint(second.w), hit.material, hit.u, hit.v};
}

// Adds a triangle with its own corners.
inline void add_triangle(render::Scene& scene, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
                         std::uint32_t material = 0) {
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  const glm::vec3 cross = glm::cross(b - a, c - a);
  const glm::vec3 normal = glm::dot(cross, cross) > 0.0F ? glm::normalize(cross) : glm::vec3(0, 1, 0);
  for (const glm::vec3& p : {a, b, c}) scene.vertices.push_back({p, normal, glm::vec2(p.x, p.y)});
  scene.triangles.emplace_back(first, first + 1, first + 2);
  scene.triangle_material.push_back(material);
  while (scene.materials.size() <= material) scene.materials.emplace_back();
}

inline void add_quad(render::Scene& scene, const glm::vec3& corner, const glm::vec3& side, const glm::vec3& up,
                     std::uint32_t material = 0) {
  add_triangle(scene, corner, corner + side, corner + side + up, material);
  add_triangle(scene, corner, corner + side + up, corner + up, material);
}

inline void add_box(render::Scene& scene, const glm::vec3& low, const glm::vec3& size, std::uint32_t material = 0) {
  const glm::vec3 x(size.x, 0, 0), y(0, size.y, 0), z(0, 0, size.z);
  add_quad(scene, low, y, x, material);
  add_quad(scene, low + z, x, y, material);
  add_quad(scene, low, x, z, material);
  add_quad(scene, low + y, z, x, material);
  add_quad(scene, low, z, y, material);
  add_quad(scene, low + x, y, z, material);
}

inline render::Scene one_triangle() {
  render::Scene scene;
  add_triangle(scene, {-1, -1, -2}, {1, -1, -2}, {0, 1, -2});
  return scene;
}

// A floor of waves, sides * sides * 2 triangles on 20 m by 20 m.
inline render::Scene waves(int sides) {
  render::Scene scene;
  const auto at = [&](int i, int j) {
    const float x = 20.0F * static_cast<float>(i) / static_cast<float>(sides) - 10.0F;
    const float z = 20.0F * static_cast<float>(j) / static_cast<float>(sides) - 10.0F;
    return glm::vec3(x, 0.5F * std::sin(x) * std::cos(1.3F * z), z);
  };
  for (int i = 0; i < sides; ++i) {
    for (int j = 0; j < sides; ++j) {
      add_triangle(scene, at(i, j), at(i, j + 1), at(i + 1, j + 1), 0);
      add_triangle(scene, at(i, j), at(i + 1, j + 1), at(i + 1, j), 1);
    }
  }
  return scene;
}

// Boxes inside boxes that share their floor plane, and neighbours that share a face.
inline render::Scene nested_boxes() {
  render::Scene scene;
  for (int level = 0; level < 12; ++level) {
    const float half = 8.0F / static_cast<float>(level + 1);
    add_box(scene, {-half, 0.0F, -half}, glm::vec3(2.0F * half), static_cast<std::uint32_t>(level));
  }
  for (int i = -6; i < 6; ++i) {
    for (int j = -6; j < 6; ++j) add_box(scene, {static_cast<float>(i), 0.0F, static_cast<float>(j)}, glm::vec3(1.0F));
  }
  return scene;
}

// Triangles of all sizes, from a millimetre to tens of metres, a kilometre from the origin.
inline render::Scene far_soup(std::uint32_t seed, int count) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(-1.0F, 1.0F);
  render::Scene scene;
  const auto vector = [&] { return glm::vec3(unit(random), unit(random), unit(random)); };
  for (int i = 0; i < count; ++i) {
    const glm::vec3 centre = glm::vec3(1000.0F, -500.0F, 20.0F) + 15.0F * vector();
    const float size = std::pow(10.0F, 2.0F * unit(random) - 1.0F);
    add_triangle(scene, centre + size * vector(), centre + size * vector(), centre + size * vector());
  }
  return scene;
}

}  // namespace scene_oracle
