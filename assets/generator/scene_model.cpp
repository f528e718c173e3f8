#include "assets/generator/scene_model.hpp"

#include <stdexcept>

namespace assets {

const Node& SceneModel::node(const std::string& name) const {
  for (const Node& node : nodes) {
    if (node.name == name) return node;
  }
  throw std::out_of_range("no node named " + name);
}

std::size_t SceneModel::triangle_count() const {
  std::size_t count = 0;
  for (const Node& node : nodes) {
    for (const auto& [material, mesh] : node.parts) count += mesh.indices.size() / 3;
  }
  return count;
}

}  // namespace assets
