// The layout of the 4-wide quantised BVH and its triangles, for the builder (C++) and the traversal (GLSL).
//
// A node is four uvec4:
//   0  bits(origin.x), bits(origin.y), bits(origin.z), bits(scale.x)
//   1  bits(scale.y), bits(scale.z), low x, high x
//   2  low y, high y, low z, high z         each 4 x 8 bit, child i in bits 8i..8i+7
//   3  the references of the four children
// A child's box reaches from origin + scale * low to origin + scale * high. A reference is a node's index, or a leaf:
// kBvhLeafBit | first triangle << kBvhLeafFirstShift | count, or kBvhNoChild (its box is inverted: low 255, high 0).
// The root is node 0.
//
// The 8-wide tree over the same triangles has 16 uvec4 a node: child i's box as floats in (bits(low), reference) at i and
// (bits(high), 0) at 8 + i, so that eight invocations read a node in two fetches. A child that is not there has an
// inverted box.
//
// A triangle is three vec4 (leaf order): (v0, bits(material)), (v1 - v0, bits(original triangle)),
// (v2 - v0, bits(kBvhCulled...)).
// Its shading data are four vec4: (n0, u0), (n1, u1), (n2, u2), (v0, v1, v2, 0) with (u, v) texture coordinates.
// Where the scene has second coordinates or colours, three more vec4 a triangle follow after all of those: six floats
// (u, v) of the corners, then the corners' r, g, b, a as twelve half floats.
#ifndef VERGENCE_RENDER_SCENE_GPU_BVH_LAYOUT_H
#define VERGENCE_RENDER_SCENE_GPU_BVH_LAYOUT_H

#ifdef __cplusplus
#include <cstdint>
#define VERGENCE_BVH_UINT inline constexpr std::uint32_t
namespace render {
#else
#define VERGENCE_BVH_UINT const uint
#endif

VERGENCE_BVH_UINT kBvhNodeTexels = 4u;
VERGENCE_BVH_UINT kBvhWide = 8u;  // children of a wide node
VERGENCE_BVH_UINT kBvhWideNodeTexels = 16u;
VERGENCE_BVH_UINT kBvhTriangleTexels = 3u;
VERGENCE_BVH_UINT kBvhShadingTexels = 4u;
VERGENCE_BVH_UINT kBvhMoreTexels = 3u;
VERGENCE_BVH_UINT kBvhCulled = 1u;   // its back is not seen
VERGENCE_BVH_UINT kBvhCutOut = 2u;   // its alpha decides whether it is there
VERGENCE_BVH_UINT kBvhBlends = 4u;   // its alpha mixes it with what lies behind
VERGENCE_BVH_UINT kBvhLeafBit = 0x80000000u;
VERGENCE_BVH_UINT kBvhLeafFirstShift = 4u;
VERGENCE_BVH_UINT kBvhLeafFirstMask = 0x07FFFFFFu;  // after the shift: fewer than 2^27 triangles
VERGENCE_BVH_UINT kBvhLeafCountMask = 15u;
VERGENCE_BVH_UINT kBvhMaxLeafTriangles = 8u;
VERGENCE_BVH_UINT kBvhNoChild = 0xFFFFFFFFu;
// Each level of nodes leaves at most three children on the stack.
VERGENCE_BVH_UINT kBvhMaxDepth = 31u;
VERGENCE_BVH_UINT kBvhStackSize = 96u;

#ifdef __cplusplus
static_assert(kBvhMaxDepth * 3 + 1 <= kBvhStackSize);
}  // namespace render
#endif
#undef VERGENCE_BVH_UINT

#endif
