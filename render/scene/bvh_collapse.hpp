// A binary tree made four wide and its boxes 8-bit: the nodes of Bvh4.
#pragma once

#include "render/scene/binary_bvh.hpp"
#include "render/scene/bvh.hpp"

namespace render {

// Fills nodes and max_depth; a leaf's first triangle is its place in binary.order. The binary tree may be up to
// 2 * kBvhMaxDepth inner levels high.
[[nodiscard]] Bvh4 collapse_to_four(const BinaryBvh& binary);

}  // namespace render
