// A scene before it becomes a glTF file: materials, pictures and nodes with their triangles, lights and targets.
// Metres; x right, y up, -z forward.
#pragma once

#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "assets/generator/mesh.hpp"

namespace assets {

using MaterialId = std::size_t;

struct Picture {
  std::string name;
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb{};  // sRGB-encoded, top row first
};

struct Material {
  std::string name;
  glm::dvec3 base_colour{1.0};  // linear; multiplies the picture
  glm::dvec3 emission{0.0};     // linear radiance
  std::optional<std::size_t> picture{};
  bool double_sided = false;
  double opacity = 1.0, metallic = 0.0, roughness = 1.0;
};

struct Light {
  enum class Type { directional, point };
  Type type = Type::point;
  glm::dvec3 colour{1.0};
  double intensity = 1.0;  // cd (point), lx (directional); a node's -z is a directional light's way of travel
};

struct Node {
  std::string name;
  glm::dvec3 translation{0.0};
  glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
  bool target = false;
  bool camera = false;
  std::optional<Light> light{};
  std::map<MaterialId, Mesh> parts{};

  [[nodiscard]] Mesh& in(MaterialId material) { return parts[material]; }
};

// Sky and ambient light for renderers that have no others.
struct Environment {
  glm::dvec3 sky_zenith{0.22, 0.42, 0.80}, sky_horizon{0.74, 0.84, 0.95}, ambient{0.66, 0.65, 0.63};
};

struct SceneModel {
  std::vector<Picture> pictures;
  std::vector<Material> materials;
  std::vector<Node> nodes;
  Environment environment;

  MaterialId add(Material material) {
    materials.push_back(std::move(material));
    return materials.size() - 1;
  }
  // A picture becomes a white material that shows it.
  MaterialId add(Picture picture) {
    pictures.push_back(std::move(picture));
    return add(Material{.name = pictures.back().name, .picture = pictures.size() - 1});
  }
  [[nodiscard]] const Node& node(const std::string& name) const;
  [[nodiscard]] std::size_t triangle_count() const;
};

}  // namespace assets
