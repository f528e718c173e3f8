#include "render/scene/gltf_mesh.hpp"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <numeric>
#include <optional>

#include "render/scene/gltf_accessor.hpp"

namespace render {
namespace {

// Instances of one mesh and corners without normals make much of a small file. Four million triangles that share
// nothing stay well below; a file that asks for more memory than this is not one to build a scene of.
constexpr std::size_t kMostSceneBytes = std::size_t{1} << 30;
constexpr double kFarthest = 1e9;  // m; products in the shaders' ray tests stay finite

struct Placement {
  glm::dmat4 world;
  // Cofactors: the inverse transpose times the determinant, defined for flattening transforms too.
  glm::dmat3 normals;
  bool mirrors = false;

  explicit Placement(const glm::dmat4& m) : world(m) {
    const glm::dvec3 x(m[0]), y(m[1]), z(m[2]);
    normals = glm::dmat3(glm::cross(y, z), glm::cross(z, x), glm::cross(x, y));
    mirrors = glm::dot(x, normals[0]) < 0.0;
    if (mirrors) normals = -normals;
  }
};

struct Source {
  std::vector<glm::vec3> positions;        // world
  std::vector<glm::vec3> normals;          // world, unit or zero; empty when absent
  std::vector<glm::vec2> uvs, second_uvs;  // the second empty when no texture asks for it
  std::vector<glm::vec4> colours;          // linear; empty when absent
};

std::optional<glm::vec3> unit(const glm::dvec3& v) {
  const double length = glm::length(v);
  if (!(length > 0.0) || !std::isfinite(length)) return std::nullopt;
  return glm::vec3(v / length);
}

class PrimitiveReader {
 public:
  PrimitiveReader(const GltfDocument& document, const tinygltf::Primitive& primitive, std::string field,
                  const Placement& placement, const std::vector<UvSets>& uv_sets, Scene& scene)
      : document_(document), primitive_(primitive), field_(std::move(field)), placement_(placement), scene_(scene) {
    const std::size_t fallback = uv_sets.size() - 1;
    material_ = primitive.material < 0 ? fallback : static_cast<std::size_t>(primitive.material);
    uv_sets_ = uv_sets.at(material_);
  }

  void append() {
    if (primitive_.mode > TINYGLTF_MODE_TRIANGLE_FAN) {
      document_.fail(field_ + ".mode", "is " + std::to_string(primitive_.mode) + "; 0 to 6 are allowed");
    }
    if (primitive_.mode < TINYGLTF_MODE_TRIANGLES) return;
    const Source source = read_source();
    const std::vector<glm::uvec3> triangles = read_triangles(source.positions.size());
    check_size(source, triangles.size());
    append_triangles(source, triangles);
  }

 private:
  // Of the scene with this primitive, at most: every corner a vertex of its own.
  void check_size(const Source& source, std::size_t triangles) const {
    const std::size_t a_vertex = sizeof(Vertex) +
                                 (source.second_uvs.empty() && scene_.second_uvs.empty() ? 0 : sizeof(glm::vec2)) +
                                 (source.colours.empty() && scene_.colours.empty() ? 0 : sizeof(glm::vec4));
    const std::size_t vertices = scene_.vertices.size() + source.normals.size() + 3 * triangles;
    const std::size_t all = scene_.triangles.size() + triangles;
    const std::size_t bytes = a_vertex * vertices + (sizeof(glm::uvec3) + sizeof(std::uint32_t)) * all;
    if (bytes > kMostSceneBytes) {
      document_.fail(field_, "brings the scene to " + std::to_string(all) + " triangles that may take " +
                                 std::to_string(bytes) + " bytes; 1073741824 are allowed");
    }
  }

  [[nodiscard]] std::string attribute(const std::string& name) const { return field_ + ".attributes." + name; }

  [[nodiscard]] std::optional<int> accessor(const std::string& name) const {
    const auto found = primitive_.attributes.find(name);
    return found == primitive_.attributes.end() ? std::nullopt : std::optional<int>(found->second);
  }

  void same_count(const std::string& name, std::size_t count, std::size_t expected) const {
    if (count == expected) return;
    document_.fail(attribute(name), "has " + std::to_string(count) + " elements; POSITION has " +
                                        std::to_string(expected) + ", and the two must agree");
  }

  [[nodiscard]] Source read_source() const {
    Source source;
    const auto positions = accessor("POSITION");
    if (!positions) document_.fail(attribute("POSITION"), "is missing; triangles need it");
    source.positions = read_vec3(document_, *positions, attribute("POSITION"));
    for (std::size_t i = 0; i < source.positions.size(); ++i) {
      const glm::dvec3 p(placement_.world * glm::dvec4(source.positions[i], 1.0));
      if (!(std::abs(p.x) < kFarthest && std::abs(p.y) < kFarthest && std::abs(p.z) < kFarthest)) {
        document_.fail(attribute("POSITION"), "element " + std::to_string(i) +
                                                  " lies outside the world; coordinates within 1e9 m are allowed");
      }
      source.positions[i] = glm::vec3(p);
    }
    if (const auto normals = accessor("NORMAL")) {
      source.normals = read_vec3(document_, *normals, attribute("NORMAL"));
      same_count("NORMAL", source.normals.size(), source.positions.size());
      for (glm::vec3& n : source.normals) n = unit(placement_.normals * glm::dvec3(n)).value_or(glm::vec3(0.0F));
    }
    source.uvs = read_uvs(uv_sets_.first, source.positions.size());
    if (uv_sets_.second) source.second_uvs = read_uvs(*uv_sets_.second, source.positions.size());
    if (const auto colours = accessor("COLOR_0")) {
      source.colours = read_colours(document_, *colours, attribute("COLOR_0"));
      same_count("COLOR_0", source.colours.size(), source.positions.size());
    }
    return source;
  }

  // A texture without its coordinates shows its first texel.
  [[nodiscard]] std::vector<glm::vec2> read_uvs(int set, std::size_t count) const {
    const std::string name = "TEXCOORD_" + std::to_string(set);
    const auto source = accessor(name);
    if (!source) return std::vector<glm::vec2>(count, glm::vec2(0.0F));
    std::vector<glm::vec2> uvs = read_texture_coordinates(document_, *source, attribute(name));
    same_count(name, uvs.size(), count);
    return uvs;
  }

  // glTF 2.0, section 3.7.2.1: the corners of the i-th triangle of a list, strip or fan.
  [[nodiscard]] std::vector<glm::uvec3> read_triangles(std::size_t vertices) const {
    std::vector<std::uint32_t> v;
    if (primitive_.indices >= 0) {
      v = read_indices(document_, primitive_.indices, field_ + ".indices", vertices);
    } else {
      v.resize(vertices);
      std::iota(v.begin(), v.end(), 0U);
    }
    const bool list = primitive_.mode == TINYGLTF_MODE_TRIANGLES;
    if (v.size() < 3 || (list && v.size() % 3 != 0)) {
      document_.fail(primitive_.indices >= 0 ? field_ + ".indices" : attribute("POSITION"),
                     "gives " + std::to_string(v.size()) + " corners; " +
                         (list ? "a multiple of 3 is allowed" : "at least 3 are required"));
    }
    std::vector<glm::uvec3> triangles;
    for (std::size_t i = 0; i + 2 < v.size(); i += list ? 3 : 1) {
      if (primitive_.mode == TINYGLTF_MODE_TRIANGLE_FAN) {
        triangles.emplace_back(v[i + 1], v[i + 2], v[0]);
      } else {
        const std::size_t odd = list ? 0 : i % 2;
        triangles.emplace_back(v[i], v[i + 1 + odd], v[i + 2 - odd]);
      }
      if (placement_.mirrors) std::swap(triangles.back().y, triangles.back().z);
    }
    return triangles;
  }

  // Corners with a normal share their vertex; the others get one of their own with the face's normal.
  void append_triangles(const Source& source, const std::vector<glm::uvec3>& triangles) {
    const std::size_t first = scene_.vertices.size();
    for (std::size_t i = 0; i < source.normals.size(); ++i) {
      append_vertex(source, i, source.normals[i]);
    }
    for (const glm::uvec3& triangle : triangles) {
      glm::uvec3 corners;
      for (int corner = 0; corner < 3; ++corner) {
        const std::uint32_t i = triangle[corner];
        if (!source.normals.empty() && source.normals[i] != glm::vec3(0.0F)) {
          corners[corner] = static_cast<std::uint32_t>(first + i);
        } else {
          corners[corner] = static_cast<std::uint32_t>(scene_.vertices.size());
          append_vertex(source, i, face_normal(source, triangle));
        }
      }
      scene_.triangles.push_back(corners);
      scene_.triangle_material.push_back(static_cast<std::uint32_t>(material_));
    }
  }

  // Coordinates and colours that most scenes lack begin with the first vertex that has them.
  void append_vertex(const Source& source, std::size_t i, const glm::vec3& normal) {
    scene_.vertices.push_back({source.positions[i], normal, source.uvs[i]});
    if (!source.second_uvs.empty() || !scene_.second_uvs.empty()) {
      scene_.second_uvs.resize(scene_.vertices.size(), glm::vec2(0.0F));
      if (!source.second_uvs.empty()) scene_.second_uvs.back() = source.second_uvs[i];
    }
    if (!source.colours.empty() || !scene_.colours.empty()) {
      scene_.colours.resize(scene_.vertices.size(), glm::vec4(1.0F));
      if (!source.colours.empty()) scene_.colours.back() = source.colours[i];
    }
  }

  // A triangle without area is never seen; its normal only has to be a unit vector.
  static glm::vec3 face_normal(const Source& source, const glm::uvec3& t) {
    const glm::dvec3 v0(source.positions[t.x]), v1(source.positions[t.y]), v2(source.positions[t.z]);
    return unit(glm::cross(v1 - v0, v2 - v0)).value_or(glm::vec3(0.0F, 1.0F, 0.0F));
  }

  const GltfDocument& document_;
  const tinygltf::Primitive& primitive_;
  std::string field_;
  const Placement& placement_;
  Scene& scene_;
  std::size_t material_ = 0;
  UvSets uv_sets_;
};

}  // namespace

void append_mesh(const GltfDocument& document, int mesh, const glm::dmat4& world_from_mesh,
                 const std::vector<UvSets>& uv_sets, Scene& scene) {
  const Placement placement(world_from_mesh);
  const auto& primitives = document.model.meshes.at(static_cast<std::size_t>(mesh)).primitives;
  for (std::size_t i = 0; i < primitives.size(); ++i) {
    const std::string field = "meshes[" + std::to_string(mesh) + "].primitives[" + std::to_string(i) + "]";
    PrimitiveReader(document, primitives[i], field, placement, uv_sets, scene).append();
  }
}

}  // namespace render
