// Materials and textures of a glTF, and where a material's texture coordinates come from.
#pragma once

#include <cstdint>
#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>
#include <vector>

#include "render/scene/gltf_document.hpp"
#include "render/scene/scene.hpp"

namespace render {

// The vertex attribute TEXCOORD_<set>, then KHR_texture_transform: uv' = linear * uv + offset. One for each material,
// because a vertex carries one pair of coordinates.
struct UvSource {
  int set = 0;
  glm::mat2 linear{1.0F};
  glm::vec2 offset{0.0F};

  bool operator==(const UvSource&) const = default;
};

// Fills scene.materials (one more than the file has: the default material, last) and scene.textures (those in use).
// Returns one entry a material.
[[nodiscard]] std::vector<UvSource> read_materials(const GltfDocument& document, Scene& scene);

// Decodes the image of a glTF texture (PNG or JPEG) and takes its sampler's wrap modes.
[[nodiscard]] Texture read_texture(const GltfDocument& document, int texture);

}  // namespace render
