// The acceleration structures that the shaders trace: a 4-wide BVH with 8-bit child boxes for single rays and an 8-wide
// one for whole tiles of rays (gpu/bvh_layout.h says what each word holds). Both are collapsed from the one binary tree
// of Embree's SAH builder and share its order of triangles.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec4.hpp>
#include <vector>

#include "render/scene/scene.hpp"

namespace render {

struct Bvh4 {
  std::vector<glm::uvec4> nodes;     // kBvhNodeTexels a node
  std::vector<glm::vec4> triangles;  // kBvhTriangleTexels a triangle, in leaf order; the fourth component of the
                                     // first is the bits of the material, of the second those of Scene's triangle
  std::uint32_t max_depth = 0;       // levels of nodes; the traversal's stack holds at most 3 * max_depth + 1
};

struct Bvh8 {
  std::vector<glm::uvec4> nodes;  // kBvhWideNodeTexels a node
};

struct SceneBvh {
  Bvh4 four;
  Bvh8 eight;
};

// What shading needs of a triangle: kBvhShadingTexels vec4.
struct ShadingTriangle {
  std::array<glm::vec4, 3> normal_u;  // (normal of corner i, u of corner i)
  glm::vec4 v;                        // (v of corners 0, 1, 2, unused)
};
static_assert(sizeof(ShadingTriangle) == 4 * sizeof(glm::vec4));

// Triangles without an area are kept out; a scene of nothing else is refused with InputError.
[[nodiscard]] SceneBvh build_scene_bvh(const Scene& scene);
[[nodiscard]] Bvh4 build_bvh4(const Scene& scene);

// In leaf order, one for each triangle of the BVH.
[[nodiscard]] std::vector<ShadingTriangle> shading_triangles(const Scene& scene, const Bvh4& bvh);

}  // namespace render
