// A binary tree made eight wide, with float boxes: the nodes of Bvh8.
#pragma once

#include "render/scene/binary_bvh.hpp"
#include "render/scene/bvh.hpp"

namespace render {

// The eight-wide tree of fewest visits expected of tiles that are seen from around `viewer`, leaves of up to
// kBvhMaxLeafTriangles. A leaf's first triangle is its place in binary.order.
[[nodiscard]] Bvh8 collapse_to_eight(const BinaryBvh& binary, const glm::vec3& viewer);

}  // namespace render
