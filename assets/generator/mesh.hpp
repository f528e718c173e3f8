// Triangles of one material and the solids they are made of. Metres; every triangle is counter-clockwise seen from
// outside. Nothing here knows what the solids are for.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace assets {

struct Mesh {
  std::vector<glm::dvec3> positions;
  std::vector<glm::dvec3> normals;  // unit
  std::vector<glm::dvec2> uvs;      // glTF: v runs down the picture
  std::vector<std::uint32_t> indices;

  std::uint32_t add_vertex(const glm::dvec3& position, const glm::dvec3& normal, const glm::dvec2& uv = {});
  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  // from's vertices moved by a rigid or uniformly scaled transform.
  void append(const Mesh& from, const glm::dmat4& transform);
};

struct Box {
  glm::dvec3 low, high;
};

// One flat face a, b, c, d (counter-clockwise), uv (0,1) (1,1) (1,0) (0,0): upright for a picture whose a is bottom
// left.
void add_quad(Mesh& mesh, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d);

// Axis-parallel box; uv in units of texture_size metres, its u along the box's longest edge so that grain follows it.
void add_box(Mesh& mesh, const Box& box, double texture_size = 1.0);

// Box whose edges are rounded with the given radius; steps quads along each side of a face.
void add_rounded_box(Mesh& mesh, const Box& box, double radius, int steps = 6);

// Surface of revolution about the y axis; profile points are (radius, height), outside to the right of the way along
// them from low to high. A smooth profile shares normals between its segments, the other has creases.
enum class Profile { creased, smooth };
void add_lathe(Mesh& mesh, const glm::dvec3& base, std::span<const glm::dvec2> profile, int segments,
               Profile kind = Profile::creased);

void add_sphere(Mesh& mesh, const glm::dvec3& centre, double radius, int segments);

// Round bar from one point to another, its radii may differ; open ends.
void add_bar(Mesh& mesh, const glm::dvec3& from, const glm::dvec3& to, double radius_from, double radius_to,
             int segments);

// Leaf-like quad strip: a flat two-triangle rhombus with its tip along `along`, width across.
void add_leaf(Mesh& mesh, const glm::dvec3& root, const glm::dvec3& along, const glm::dvec3& across);

}  // namespace assets
