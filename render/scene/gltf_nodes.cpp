#include "render/scene/gltf_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

namespace render {
namespace {

constexpr std::size_t kDeepestNode = 256;

std::string node_field(std::size_t node) {
  return "nodes[" + std::to_string(node) + "]";
}

// The parent of each node, -1 for a root.
std::vector<int> find_parents(const GltfDocument& document) {
  const auto& nodes = document.model.nodes;
  std::vector<int> parents(nodes.size(), -1);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (std::size_t j = 0; j < nodes[i].children.size(); ++j) {
      int& parent = parents.at(static_cast<std::size_t>(nodes[i].children[j]));
      if (parent >= 0) {
        document.fail(node_field(i) + ".children[" + std::to_string(j) + "]",
                      "names node " + std::to_string(nodes[i].children[j]) + ", which is a child of node " +
                          std::to_string(parent) + " already; one parent is allowed");
      }
      parent = static_cast<int>(i);
    }
  }
  return parents;
}

void check_depth(const GltfDocument& document, const std::vector<int>& parents) {
  for (std::size_t i = 0; i < parents.size(); ++i) {
    std::size_t depth = 1;
    for (int up = parents[i]; up >= 0; up = parents[static_cast<std::size_t>(up)]) {
      if (static_cast<std::size_t>(up) == i) {
        document.fail(node_field(i), "is its own descendant; the nodes must form a tree");
      }
      if (++depth > kDeepestNode) {
        document.fail(node_field(i),
                      "lies more than 256 levels deep or below a node that is its own descendant; a "
                      "tree of at most 256 levels is allowed");
      }
    }
  }
}

glm::dmat4 local_transform(const GltfDocument& document, std::size_t index) {
  const tinygltf::Node& node = document.model.nodes[index];
  glm::dmat4 local(1.0);
  if (!node.matrix.empty()) {
    for (int i = 0; i < 16; ++i) local[i / 4][i % 4] = node.matrix[static_cast<std::size_t>(i)];
    if (local[0][3] != 0.0 || local[1][3] != 0.0 || local[2][3] != 0.0 || local[3][3] != 1.0) {
      document.fail(node_field(index) + ".matrix",
                    "has a fourth row other than 0, 0, 0, 1; an affine matrix is allowed");
    }
    return local;
  }
  const auto& t = node.translation;
  const auto& r = node.rotation;
  const auto& s = node.scale;
  if (!t.empty()) local = glm::translate(local, glm::dvec3(t[0], t[1], t[2]));
  if (!r.empty()) {
    const glm::dquat q(r[3], r[0], r[1], r[2]);
    if (!(std::abs(glm::length(q) - 1.0) < 1e-2)) {
      document.fail(node_field(index) + ".rotation",
                    "has length " + std::to_string(glm::length(q)) + "; a unit quaternion x, y, z, w is required");
    }
    local *= glm::mat4_cast(glm::normalize(q));
  }
  if (!s.empty()) local = glm::scale(local, glm::dvec3(s[0], s[1], s[2]));
  return local;
}

std::vector<int> scene_roots(const GltfDocument& document, const std::vector<int>& parents) {
  const tinygltf::Model& model = document.model;
  std::vector<int> roots;
  if (model.scenes.empty()) {
    for (std::size_t i = 0; i < parents.size(); ++i) {
      if (parents[i] < 0) roots.push_back(static_cast<int>(i));
    }
    return roots;
  }
  const auto scene = static_cast<std::size_t>(std::max(model.defaultScene, 0));
  roots = model.scenes.at(scene).nodes;
  std::vector<bool> listed(model.nodes.size(), false);
  for (std::size_t i = 0; i < roots.size(); ++i) {
    const auto node = static_cast<std::size_t>(roots[i]);
    if (parents[node] >= 0 || listed[node]) {
      document.fail("scenes[" + std::to_string(scene) + "].nodes[" + std::to_string(i) + "]",
                    "names node " + std::to_string(node) + (listed[node] ? " twice" : ", which has a parent") +
                        "; each root once is allowed");
    }
    listed[node] = true;
  }
  return roots;
}

// Finite, and the origin where float coordinates still serve.
bool is_in_the_world(const glm::dmat4& m) {
  double sum = 0.0;
  for (int i = 0; i < 4; ++i) sum += glm::dot(m[i], m[i]);
  return std::isfinite(sum) && std::abs(m[3].x) < 1e9 && std::abs(m[3].y) < 1e9 && std::abs(m[3].z) < 1e9;
}

}  // namespace

std::vector<PlacedNode> placed_nodes(const GltfDocument& document) {
  const std::vector<int> parents = find_parents(document);
  check_depth(document, parents);
  const std::vector<int> roots = scene_roots(document, parents);
  std::vector<PlacedNode> placed;
  std::vector<PlacedNode> open;  // its transform is the parent's until it is taken out
  for (auto root = roots.rbegin(); root != roots.rend(); ++root) open.push_back({*root, glm::dmat4(1.0)});
  while (!open.empty()) {
    PlacedNode node = open.back();
    open.pop_back();
    const auto index = static_cast<std::size_t>(node.index);
    node.world_from_node = node.world_from_node * local_transform(document, index);
    if (!is_in_the_world(node.world_from_node)) {
      document.fail(node.field(), "stands outside the world; finite transforms and positions within 1e9 m are allowed");
    }
    placed.push_back(node);
    const auto& children = document.model.nodes[index].children;
    for (auto child = children.rbegin(); child != children.rend(); ++child) {
      open.push_back({*child, node.world_from_node});
    }
  }
  return placed;
}

}  // namespace render
