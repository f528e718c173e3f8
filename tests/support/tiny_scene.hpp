// Scenes of a few flat patches, as glTF text and as the renderer takes them.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "render/scene/scene.hpp"
#include "tests/unit/gltf_fixture.hpp"

namespace support {

// A parallelogram that gives off light and reflects none.
struct Patch {
  glm::vec3 corner, side, up;  // m, world
  float radiance = 0.0F;       // the same in r, g and b
};

struct NamedPoint {
  std::string name;
  glm::vec3 position;
};

// Black sky and no light but the patches' own.
inline gltf_fixture::Gltf patch_gltf(const std::vector<Patch>& patches, const std::vector<NamedPoint>& targets = {}) {
  using gltf_fixture::json;
  gltf_fixture::Gltf gltf;
  const json black = {0, 0, 0};
  gltf.root["asset"]["extras"]["vergence"] = {{"sky_zenith", black}, {"sky_horizon", black}, {"ambient", black}};
  gltf.root["extensionsUsed"] = {"KHR_materials_emissive_strength"};
  json primitives = json::array();
  for (const Patch& patch : patches) {
    std::vector<float> corners;
    for (const glm::vec3& p :
         {patch.corner, patch.corner + patch.side, patch.corner + patch.side + patch.up, patch.corner + patch.up}) {
      corners.insert(corners.end(), {p.x, p.y, p.z});
    }
    const int positions = gltf.accessor(corners, "VEC3", gltf_fixture::kF32, 4);
    const int indices = gltf.accessor(std::vector<std::uint16_t>{0, 1, 2, 0, 2, 3}, "SCALAR", gltf_fixture::kU16, 6);
    const int material = gltf.add(
        "materials", {{"emissiveFactor", {1, 1, 1}},
                      {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", patch.radiance}}}}}});
    primitives.push_back({{"attributes", {{"POSITION", positions}}}, {"indices", indices}, {"material", material}});
  }
  gltf.root["meshes"] = {{{"primitives", primitives}}};
  json roots = json::array({gltf.add("nodes", {{"mesh", 0}})});
  for (const NamedPoint& target : targets) {
    roots.push_back(gltf.add("nodes", {{"name", target.name},
                                       {"translation", {target.position.x, target.position.y, target.position.z}},
                                       {"extras", {{"target", true}}}}));
  }
  gltf.root["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
  roots.push_back(gltf.add("nodes", {{"name", "origin"}, {"camera", 0}}));
  gltf.root["scenes"] = {{{"nodes", roots}}};
  gltf.root["scene"] = 0;
  return gltf;
}

// A wall across the view, `distance` ahead of the origin.
inline Patch wall(float distance, float half_width, float radiance) {
  return {{-half_width, -half_width, -distance}, {2 * half_width, 0, 0}, {0, 2 * half_width, 0}, radiance};
}

inline render::Scene patch_scene(const std::vector<Patch>& patches, const std::vector<NamedPoint>& targets = {}) {
  return gltf_fixture::read(patch_gltf(patches, targets));
}

}  // namespace support
