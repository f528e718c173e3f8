// The binary SAH tree that Embree's builder gives, as plain data.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace render {

struct Box {
  glm::vec3 low, high;
};

struct BinaryNode {
  Box box;
  std::uint32_t left = 0, right = 0;   // indices of nodes; an inner node has count == 0
  std::uint32_t first = 0, count = 0;  // a leaf's triangles: places in BinaryBvh::order
  std::uint32_t height = 0;            // levels of inner nodes from here down; 0 for a leaf
};

struct BinaryBvh {
  std::vector<BinaryNode> nodes;     // the root is nodes[0]; a parent stands before its children
  std::vector<std::uint32_t> order;  // indices into the boxes, leaf by leaf
};

// boxes: at least one. A leaf holds at most max_leaf of them; no path is longer than max_depth inner nodes. Boxes are
// counted in blocks, so that splits fall where blocks are full.
[[nodiscard]] BinaryBvh build_binary_bvh(std::span<const Box> boxes, std::uint32_t max_leaf, std::uint32_t block,
                                         std::uint32_t max_depth);

}  // namespace render
