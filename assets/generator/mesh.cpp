#include "assets/generator/mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/mat3x3.hpp>

namespace assets {
namespace {

constexpr double kTwoPi = glm::two_pi<double>();

// One grid of vertices, (rows + 1) x (columns + 1), already added row by row from `first`.
void add_grid_triangles(Mesh& mesh, std::uint32_t first, int rows, int columns) {
  const auto stride = static_cast<std::uint32_t>(columns + 1);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const std::uint32_t a = first + static_cast<std::uint32_t>(row) * stride + static_cast<std::uint32_t>(column);
      mesh.add_triangle(a, a + 1, a + stride + 1);
      mesh.add_triangle(a, a + stride + 1, a + stride);
    }
  }
}

}  // namespace

std::uint32_t Mesh::add_vertex(const glm::dvec3& position, const glm::dvec3& normal, const glm::dvec2& uv) {
  positions.push_back(position);
  normals.push_back(normal);
  uvs.push_back(uv);
  return static_cast<std::uint32_t>(positions.size() - 1);
}

void Mesh::add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  // Poles of lathes and tips of cones collapse an edge: such a triangle covers nothing.
  const glm::dvec3 normal = glm::cross(positions[b] - positions[a], positions[c] - positions[a]);
  if (glm::dot(normal, normal) <= 0.0) return;
  indices.insert(indices.end(), {a, b, c});
}

void Mesh::append(const Mesh& from, const glm::dmat4& transform) {
  const auto first = static_cast<std::uint32_t>(positions.size());
  for (std::size_t i = 0; i < from.positions.size(); ++i) {
    add_vertex(glm::dvec3(transform * glm::dvec4(from.positions[i], 1.0)),
               glm::normalize(glm::dmat3(transform) * from.normals[i]), from.uvs[i]);
  }
  for (const std::uint32_t index : from.indices) indices.push_back(first + index);
}

void add_quad(Mesh& mesh, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
  const glm::dvec3 normal = glm::normalize(glm::cross(c - a, d - b));
  const std::uint32_t first = mesh.add_vertex(a, normal, {0.0, 1.0});
  mesh.add_vertex(b, normal, {1.0, 1.0});
  mesh.add_vertex(c, normal, {1.0, 0.0});
  mesh.add_vertex(d, normal, {0.0, 0.0});
  mesh.add_triangle(first, first + 1, first + 2);
  mesh.add_triangle(first, first + 2, first + 3);
}

void add_box(Mesh& mesh, const Box& box, double texture_size) {
  const glm::dvec3 size = box.high - box.low;
  const int grain = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
  for (int axis = 0; axis < 3; ++axis) {
    const int s = (axis + 1) % 3, t = (axis + 2) % 3;
    for (const bool high : {false, true}) {
      glm::dvec3 normal(0.0);
      normal[axis] = high ? 1.0 : -1.0;
      const std::array<glm::bvec2, 4> corners =
          high ? std::array<glm::bvec2, 4>{glm::bvec2(0, 0), {1, 0}, {1, 1}, {0, 1}}
               : std::array<glm::bvec2, 4>{glm::bvec2(0, 0), {0, 1}, {1, 1}, {1, 0}};
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      for (const glm::bvec2& corner : corners) {
        glm::dvec3 p;
        p[axis] = high ? box.high[axis] : box.low[axis];
        p[s] = corner.x ? box.high[s] : box.low[s];
        p[t] = corner.y ? box.high[t] : box.low[t];
        const glm::dvec2 uv = t == grain ? glm::dvec2(p[t], p[s]) : glm::dvec2(p[s], p[t]);
        mesh.add_vertex(p, normal, uv / texture_size);
      }
      mesh.add_triangle(first, first + 1, first + 2);
      mesh.add_triangle(first, first + 2, first + 3);
    }
  }
}

void add_rounded_box(Mesh& mesh, const Box& box, double radius, int steps) {
  const glm::dvec3 inner_low = box.low + radius, inner_high = box.high - radius;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      const int s = sign > 0.0 ? (axis + 1) % 3 : (axis + 2) % 3;
      const int t = sign > 0.0 ? (axis + 2) % 3 : (axis + 1) % 3;
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      for (int row = 0; row <= steps; ++row) {
        for (int column = 0; column <= steps; ++column) {
          // A cosine spacing puts most of the rows where the edge is round.
          const double a = 0.5 - 0.5 * std::cos(glm::pi<double>() * column / steps);
          const double b = 0.5 - 0.5 * std::cos(glm::pi<double>() * row / steps);
          glm::dvec3 p;
          p[axis] = sign > 0.0 ? box.high[axis] : box.low[axis];
          p[s] = box.low[s] + a * (box.high[s] - box.low[s]);
          p[t] = box.low[t] + b * (box.high[t] - box.low[t]);
          const glm::dvec3 core = glm::clamp(p, inner_low, inner_high);
          const glm::dvec3 normal = glm::normalize(p - core);
          mesh.add_vertex(core + radius * normal, normal, {a, b});
        }
      }
      add_grid_triangles(mesh, first, steps, steps);
    }
  }
}

void add_lathe(Mesh& mesh, const glm::dvec3& base, std::span<const glm::dvec2> profile, int segments, Profile kind) {
  const auto segment_normal = [&](std::size_t i) {
    const glm::dvec2 along = profile[i + 1] - profile[i];
    return glm::normalize(glm::dvec2(along.y, -along.x));
  };
  const std::size_t bands = profile.size() - 1;
  for (std::size_t band = 0; band < bands; ++band) {
    std::array<glm::dvec2, 2> normal{segment_normal(band), segment_normal(band)};
    if (kind == Profile::smooth && band > 0) normal[0] = glm::normalize(normal[0] + segment_normal(band - 1));
    if (kind == Profile::smooth && band + 1 < bands) normal[1] = glm::normalize(normal[1] + segment_normal(band + 1));
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (std::size_t end = 0; end < 2; ++end) {
      const glm::dvec2 point = profile[band + end];
      for (int i = 0; i <= segments; ++i) {
        const double angle = kTwoPi * (i % segments) / segments;
        const glm::dvec3 out(std::cos(angle), 0.0, -std::sin(angle));
        mesh.add_vertex(base + point.x * out + glm::dvec3(0.0, point.y, 0.0),
                        normal[end].x * out + glm::dvec3(0.0, normal[end].y, 0.0),
                        {static_cast<double>(i) / segments, point.y});
      }
    }
    add_grid_triangles(mesh, first, 1, segments);
  }
}

void add_sphere(Mesh& mesh, const glm::dvec3& centre, double radius, int segments) {
  std::vector<glm::dvec2> profile;
  const int rows = segments / 2;
  for (int i = 0; i <= rows; ++i) {
    const double angle = glm::pi<double>() * i / rows;
    const double across = i == 0 || i == rows ? 0.0 : radius * std::sin(angle);
    profile.emplace_back(across, -radius * std::cos(angle));
  }
  add_lathe(mesh, centre, profile, segments, Profile::smooth);
}

void add_bar(Mesh& mesh, const glm::dvec3& from, const glm::dvec3& to, double radius_from, double radius_to,
             int segments) {
  const glm::dvec3 along = glm::normalize(to - from);
  const glm::dvec3 helper = std::abs(along.y) < 0.9 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0);
  const glm::dvec3 across = glm::normalize(glm::cross(helper, along));
  const glm::dvec3 third = glm::cross(along, across);
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const bool end : {false, true}) {
    for (int i = 0; i <= segments; ++i) {
      const double angle = kTwoPi * (i % segments) / segments;
      const glm::dvec3 out = std::cos(angle) * across + std::sin(angle) * third;
      mesh.add_vertex((end ? to : from) + (end ? radius_to : radius_from) * out, out,
                      {static_cast<double>(i) / segments, end ? 1.0 : 0.0});
    }
  }
  add_grid_triangles(mesh, first, 1, segments);
}

void add_leaf(Mesh& mesh, const glm::dvec3& root, const glm::dvec3& along, const glm::dvec3& across) {
  const glm::dvec3 normal = glm::normalize(glm::cross(across, along));
  const std::uint32_t first = mesh.add_vertex(root, normal);
  mesh.add_vertex(root + 0.5 * along + 0.5 * across, normal);
  mesh.add_vertex(root + along, normal);
  mesh.add_vertex(root + 0.5 * along - 0.5 * across, normal);
  mesh.add_triangle(first, first + 1, first + 2);
  mesh.add_triangle(first, first + 2, first + 3);
}

}  // namespace assets
