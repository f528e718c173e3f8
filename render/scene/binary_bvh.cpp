#include "render/scene/binary_bvh.hpp"

#include <algorithm>
#include <new>

#include "render/scene/embree_device.hpp"

namespace render {
namespace {

// Embree hands out the memory of these from its own allocator; it lives until the RTCBVH is released.
struct EmbreeNode {
  std::uint32_t count;  // 0 for an inner node
};

struct EmbreeInner : EmbreeNode {
  RTCBounds bounds[2];
  EmbreeNode* child[2];
};

// As many numbers of boxes as its count says stand behind it.
struct EmbreeLeaf : EmbreeNode {
  [[nodiscard]] std::uint32_t* boxes() { return reinterpret_cast<std::uint32_t*>(this + 1); }
  [[nodiscard]] const std::uint32_t* boxes() const { return reinterpret_cast<const std::uint32_t*>(this + 1); }
};

void* create_inner(RTCThreadLocalAllocator allocator, unsigned, void*) {
  auto* node = new (rtcThreadLocalAlloc(allocator, sizeof(EmbreeInner), 16)) EmbreeInner{};
  return static_cast<EmbreeNode*>(node);
}

void set_children(void* node, void** children, unsigned, void*) {
  auto* inner = static_cast<EmbreeInner*>(static_cast<EmbreeNode*>(node));
  for (int i = 0; i < 2; ++i) inner->child[i] = static_cast<EmbreeNode*>(children[i]);
}

void set_bounds(void* node, const RTCBounds** bounds, unsigned, void*) {
  auto* inner = static_cast<EmbreeInner*>(static_cast<EmbreeNode*>(node));
  for (int i = 0; i < 2; ++i) inner->bounds[i] = *bounds[i];
}

void* create_leaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives, std::size_t count, void*) {
  const std::size_t bytes = sizeof(EmbreeLeaf) + count * sizeof(std::uint32_t);
  auto* leaf = new (rtcThreadLocalAlloc(allocator, bytes, alignof(EmbreeLeaf))) EmbreeLeaf{};
  leaf->count = static_cast<std::uint32_t>(count);
  for (std::size_t i = 0; i < count; ++i) leaf->boxes()[i] = primitives[i].primID;
  // The builder partitions in parallel, so the order inside a leaf is not repeatable by itself.
  std::sort(leaf->boxes(), leaf->boxes() + count);
  return static_cast<EmbreeNode*>(leaf);
}

// Embree asks for 32-byte aligned primitives, which std::vector honours since C++17.
std::vector<RTCBuildPrimitive> build_primitives(std::span<const Box> boxes) {
  std::vector<RTCBuildPrimitive> primitives(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Box& box = boxes[i];
    primitives[i] = {box.low.x, box.low.y, box.low.z, 0, box.high.x, box.high.y, box.high.z, static_cast<unsigned>(i)};
  }
  return primitives;
}

Box box_of(const RTCBounds& b) {
  return {{b.lower_x, b.lower_y, b.lower_z}, {b.upper_x, b.upper_y, b.upper_z}};
}

// Depth first, left before right. The path is bounded, so recursion is safe.
std::uint32_t append(BinaryBvh& bvh, const EmbreeNode& source, const Box& box) {
  const auto index = static_cast<std::uint32_t>(bvh.nodes.size());
  bvh.nodes.push_back({.box = box});
  if (source.count != 0) {
    const auto& leaf = static_cast<const EmbreeLeaf&>(source);
    bvh.nodes[index].first = static_cast<std::uint32_t>(bvh.order.size());
    bvh.nodes[index].count = leaf.count;
    bvh.order.insert(bvh.order.end(), leaf.boxes(), leaf.boxes() + leaf.count);
    return index;
  }
  const auto& inner = static_cast<const EmbreeInner&>(source);
  const std::uint32_t left = append(bvh, *inner.child[0], box_of(inner.bounds[0]));
  const std::uint32_t right = append(bvh, *inner.child[1], box_of(inner.bounds[1]));
  BinaryNode& node = bvh.nodes[index];
  node.left = left;
  node.right = right;
  node.height = 1 + std::max(bvh.nodes[left].height, bvh.nodes[right].height);
  return index;
}

}  // namespace

BinaryBvh build_binary_bvh(std::span<const Box> boxes, std::uint32_t max_leaf, std::uint32_t block,
                           std::uint32_t max_depth) {
  const EmbreeDevice device = make_embree_device();
  const EmbreeBvh embree(rtcNewBVH(device.get()));
  check_embree(device.get(), "rtcNewBVH");
  std::vector<RTCBuildPrimitive> primitives = build_primitives(boxes);

  RTCBuildArguments arguments = rtcDefaultBuildArguments();
  arguments.buildQuality = RTC_BUILD_QUALITY_HIGH;
  arguments.maxBranchingFactor = 2;
  arguments.maxDepth = max_depth;
  arguments.maxLeafSize = max_leaf;
  arguments.sahBlockSize = block;
  arguments.bvh = embree.get();
  arguments.primitives = primitives.data();
  arguments.primitiveCount = primitives.size();
  arguments.primitiveArrayCapacity = primitives.size();
  arguments.createNode = create_inner;
  arguments.setNodeChildren = set_children;
  arguments.setNodeBounds = set_bounds;
  arguments.createLeaf = create_leaf;
  const void* root = rtcBuildBVH(&arguments);
  check_embree(device.get(), "rtcBuildBVH");
  if (root == nullptr) throw std::runtime_error("Embree: rtcBuildBVH gave no tree");

  Box all = boxes[0];
  for (const Box& box : boxes) {
    all.low = glm::vec3(std::min(all.low.x, box.low.x), std::min(all.low.y, box.low.y), std::min(all.low.z, box.low.z));
    all.high =
        glm::vec3(std::max(all.high.x, box.high.x), std::max(all.high.y, box.high.y), std::max(all.high.z, box.high.z));
  }
  BinaryBvh bvh;
  bvh.nodes.reserve(boxes.size());
  bvh.order.reserve(boxes.size());
  append(bvh, *static_cast<const EmbreeNode*>(root), all);
  if (bvh.nodes[0].height > max_depth) throw std::runtime_error("Embree: the tree is deeper than asked for");
  return bvh;
}

}  // namespace render
