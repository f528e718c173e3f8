#include "render/scene/bvh.hpp"

#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <string>

#include "render/scene/binary_bvh.hpp"
#include "render/scene/bvh8.hpp"
#include "render/scene/bvh_collapse.hpp"
#include "render/scene/gpu/bvh_layout.h"
#include "tracking/input_error.hpp"

namespace render {
namespace {

// Of the four-wide tree. Larger leaves save nodes, but each triangle costs three texel fetches where a box costs one:
// a ray to four million triangles fetches 71, 69 and 73 texels with leaves of 1, 2 and 4.
constexpr std::uint32_t kLeafTriangles = 2;
static_assert(kLeafTriangles <= kBvhMaxLeafTriangles);

struct Corner {
  glm::vec3 v0, e1, e2;
};

Corner corner_of(const Scene& scene, std::uint32_t triangle) {
  const glm::uvec3 index = scene.triangles[triangle];
  const glm::vec3 v0 = scene.vertices[index.x].position;
  return {v0, scene.vertices[index.y].position - v0, scene.vertices[index.z].position - v0};
}

// The intersection divides by a determinant that is a multiple of this vector's length.
bool has_area(const Corner& c) {
  const glm::vec3 normal = glm::cross(c.e1, c.e2);
  const float length = glm::dot(normal, normal);
  return std::isfinite(length) && length > 0.0F;
}

std::uint32_t flags_of(const Scene& scene, std::uint32_t triangle) {
  const Material& material = scene.materials.at(scene.triangle_material[triangle]);
  return (material.double_sided ? 0U : kBvhCulled) | (material.alpha == Material::Alpha::mask ? kBvhCutOut : 0U) |
         (material.alpha == Material::Alpha::blend ? kBvhBlends : 0U);
}

// The box of the triangle that the shader sees (v0, v0 + e1, v0 + e2), widened by what float32 rounding of a box plane
// can take away: a few units in the last place of the coordinates, and at least a nanometre, so that a ray in the
// plane of a face is strictly inside.
Box box_of(const Corner& c) {
  const glm::vec3 a = c.v0 + c.e1, b = c.v0 + c.e2;
  const glm::vec3 low = glm::min(c.v0, glm::min(a, b)), high = glm::max(c.v0, glm::max(a, b));
  const glm::vec3 pad = glm::max(glm::abs(low), glm::abs(high)) * 0x1p-21F + 1e-9F;
  return {low - pad, high + pad};
}

}  // namespace

SceneBvh build_scene_bvh(const Scene& scene) {
  std::vector<std::uint32_t> kept;
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
    const auto triangle = static_cast<std::uint32_t>(i);
    const Corner corner = corner_of(scene, triangle);
    if (!has_area(corner)) continue;
    kept.push_back(triangle);
    boxes.push_back(box_of(corner));
  }
  if (kept.empty()) {
    throw tracking::InputError(scene.source, "meshes", "no triangle has an area; at least one with an area is needed");
  }
  if (kept.size() > kBvhLeafFirstMask) {
    throw tracking::InputError(scene.source, "meshes",
                               std::to_string(kept.size()) + " triangles; at most 134217727 are allowed");
  }

  const BinaryBvh binary = build_binary_bvh(boxes, kLeafTriangles, kBvhMaxLeafTriangles, 2 * kBvhMaxDepth);
  const glm::vec3 viewer(scene.start_pose().value_or(tracking::Pose{}).position);
  SceneBvh both{collapse_to_four(binary), collapse_to_eight(binary, viewer)};
  Bvh4& bvh = both.four;
  bvh.triangles.reserve(kept.size() * kBvhTriangleTexels);
  for (const std::uint32_t place : binary.order) {
    const std::uint32_t triangle = kept[place];
    const Corner c = corner_of(scene, triangle);
    bvh.triangles.emplace_back(c.v0, std::bit_cast<float>(scene.triangle_material[triangle]));
    bvh.triangles.emplace_back(c.e1, std::bit_cast<float>(triangle));
    bvh.triangles.emplace_back(c.e2, std::bit_cast<float>(flags_of(scene, triangle)));
  }
  return both;
}

Bvh4 build_bvh4(const Scene& scene) {
  return build_scene_bvh(scene).four;
}

std::vector<ShadingTriangle> shading_triangles(const Scene& scene, const Bvh4& bvh) {
  const std::size_t count = bvh.triangles.size() / kBvhTriangleTexels;
  std::vector<ShadingTriangle> result(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto triangle = std::bit_cast<std::uint32_t>(bvh.triangles[i * kBvhTriangleTexels + 1].w);
    for (int corner = 0; corner < 3; ++corner) {
      const Vertex& vertex = scene.vertices[scene.triangles[triangle][corner]];
      result[i].normal_u[static_cast<std::size_t>(corner)] = glm::vec4(vertex.normal, vertex.uv.x);
      result[i].v[corner] = vertex.uv.y;
    }
  }
  return result;
}

}  // namespace render
