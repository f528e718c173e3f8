// with_normals of model_reader.hpp.
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <optional>
#include <tuple>

#include "assets/generator/model_reader.hpp"

namespace assets {
namespace {

struct Face {
  glm::dvec3 weighted{0.0};  // twice the area times the unit normal
  glm::dvec3 unit{0.0};      // zero without area
};

// Vertices at the same place count as one, whatever the file calls them.
std::vector<std::uint32_t> place_of_vertices(const std::vector<glm::dvec3>& positions) {
  std::map<std::tuple<double, double, double>, std::uint32_t> places;
  std::vector<std::uint32_t> place;
  for (const glm::dvec3& p : positions) {
    place.push_back(places.try_emplace({p.x, p.y, p.z}, static_cast<std::uint32_t>(places.size())).first->second);
  }
  return place;
}

std::vector<Face> faces_of(const ModelPart& part) {
  std::vector<Face> faces;
  for (std::size_t i = 0; i + 2 < part.indices.size(); i += 3) {
    const glm::dvec3& a = part.positions[part.indices[i]];
    const glm::dvec3 n = glm::cross(part.positions[part.indices[i + 1]] - a, part.positions[part.indices[i + 2]] - a);
    const double length = glm::length(n);
    faces.push_back({n, length > 0.0 ? n / length : glm::dvec3(0.0)});
  }
  return faces;
}

}  // namespace

Mesh with_normals(const ModelPart& part, double crease) {
  const std::vector<std::uint32_t> place = place_of_vertices(part.positions);
  const std::vector<Face> faces = faces_of(part);
  std::vector<std::vector<std::uint32_t>> around(part.positions.size());  // faces at a place
  for (std::size_t i = 0; i < part.indices.size(); ++i) {
    around[place[part.indices[i]]].push_back(static_cast<std::uint32_t>(i / 3));
  }
  Mesh mesh;
  std::vector<std::vector<std::uint32_t>> made(part.positions.size());  // vertices of the mesh at a place
  const double least = std::cos(crease);
  for (std::size_t i = 0; i < part.indices.size(); ++i) {
    const Face& face = faces[i / 3];
    const std::uint32_t at = place[part.indices[i]];
    glm::dvec3 sum(0.0);
    for (const std::uint32_t other : around[at]) {
      if (glm::dot(faces[other].unit, face.unit) > least) sum += faces[other].weighted;
    }
    const double length = glm::length(sum);
    const glm::dvec3 normal = length > 0.0 ? sum / length : glm::dvec3(0.0, 1.0, 0.0);
    std::optional<std::uint32_t> vertex;
    for (const std::uint32_t known : made[at]) {
      if (mesh.normals[known] == normal) vertex = known;
    }
    if (!vertex) {
      vertex = mesh.add_vertex(part.positions[part.indices[i]], normal);
      made[at].push_back(*vertex);
    }
    mesh.indices.push_back(*vertex);
  }
  return mesh;
}

}  // namespace assets
