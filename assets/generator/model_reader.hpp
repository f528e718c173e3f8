// Models of others, as assimp writes them into a .glb: every triangle list in the file's own coordinates, with its
// material. Only what such a file holds is understood; the program's own reader is render/scene's. Normals are made
// anew, because those converters lose them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "assets/generator/scene_model.hpp"

namespace assets {

struct ModelPart {
  std::string name;  // of the node or mesh
  std::size_t material = 0;
  std::vector<glm::dvec3> positions{};
  std::vector<std::uint32_t> indices{};  // three a triangle
};

struct Model {
  std::vector<Material> materials;
  std::vector<ModelPart> parts;
  Box bounds{};

  [[nodiscard]] std::size_t triangle_count() const;
};

// Throws std::runtime_error with the file's name when it is no such file.
[[nodiscard]] Model read_model(const std::string& path);

// Positions and triangles as a mesh: faces that meet at less than the crease angle (radians) share their normals.
// Every triangle is kept, also one without area.
[[nodiscard]] Mesh with_normals(const ModelPart& part, double crease);

}  // namespace assets
