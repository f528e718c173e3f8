// Materials and textures of a glTF, and where a material's texture coordinates come from.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "render/scene/gltf_document.hpp"
#include "render/scene/scene.hpp"

namespace render {

// Which vertex attributes TEXCOORD_<set> a material's textures ask for: a vertex carries two pairs of coordinates.
struct UvSets {
  int first = 0;
  std::optional<int> second;
};

// Fills scene.materials (one more than the file has: the default material, last) and scene.textures (those in use).
// Returns one entry a material.
[[nodiscard]] std::vector<UvSets> read_materials(const GltfDocument& document, Scene& scene);

// Decodes the image of a glTF texture (PNG or JPEG) and takes its sampler's wrap modes.
[[nodiscard]] Texture read_texture(const GltfDocument& document, int texture);

}  // namespace render
