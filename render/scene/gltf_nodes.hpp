// The node tree of a glTF: which nodes the scene shows, and where they stand.
#pragma once

#include <glm/mat4x4.hpp>
#include <string>
#include <vector>

#include "render/scene/gltf_document.hpp"

namespace render {

struct PlacedNode {
  int index;  // into model.nodes
  glm::dmat4 world_from_node;

  [[nodiscard]] std::string field() const { return "nodes[" + std::to_string(index) + "]"; }
};

// The nodes of the default scene (else scene 0, else of all roots), parents first, in the file's order. Throws for
// cycles, a second parent, trees that are too deep, and transforms that are not finite.
[[nodiscard]] std::vector<PlacedNode> placed_nodes(const GltfDocument& document);

}  // namespace render
