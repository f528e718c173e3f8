#include "render/scene/bvh_collapse.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>

#include "render/scene/gpu/bvh_layout.h"

namespace render {
namespace {

float half_area(const Box& box) {
  const glm::vec3 d = box.high - box.low;
  return d.x * d.y + d.y * d.z + d.z * d.x;
}

// One axis of a node: the grid of 256 planes, and the children's places on it.
struct Grid {
  float origin, scale;

  // As the shader evaluates it, apart from a fused multiply-add that a GPU may use; the pad covers that.
  [[nodiscard]] float plane(int step) const { return origin + scale * static_cast<float>(step); }

  [[nodiscard]] std::uint32_t at_or_below(float x) const {
    int step = std::clamp(static_cast<int>(std::floor((x - origin) / scale)), 0, 255);
    while (step > 0 && plane(step) > x) --step;
    return static_cast<std::uint32_t>(step);
  }
  [[nodiscard]] std::uint32_t at_or_above(float x) const {
    int step = std::clamp(static_cast<int>(std::ceil((x - origin) / scale)), 0, 255);
    while (step < 255 && plane(step) < x) ++step;
    return static_cast<std::uint32_t>(step);
  }
};

// The origin stands 1e-5 of the extent outside: a ray that starts near a plane loses up to 3 * 2^-24 of the node's
// extent in (origin - o) / d + step * scale / d.
Grid make_grid(float low, float high) {
  const float margin = (high - low) * 1e-5F;
  Grid grid{low - margin, (high - low + 2.0F * margin) / 255.0F};
  while (grid.plane(0) > low) grid.origin = std::nextafter(grid.origin, -HUGE_VALF);
  while (grid.plane(255) < high + margin) grid.scale = std::nextafter(grid.scale, HUGE_VALF);
  return grid;
}

class Collapse {
 public:
  Collapse(const BinaryBvh& binary, Bvh4& out) : binary_(binary), out_(out) {}

  void run() { emit(0, 1); }

 private:
  using Children = std::vector<std::uint32_t>;

  // Opens the child of largest surface until there are four. A child too tall for the levels left is opened first: of
  // two such children both fit into four places, so a tree of 2 * kBvhMaxDepth binary levels always fits.
  [[nodiscard]] Children children_of(std::uint32_t node, std::uint32_t level) const {
    if (binary_.nodes[node].count != 0) return {node};
    const std::uint32_t tallest = 2 * (kBvhMaxDepth - level);
    Children children{binary_.nodes[node].left, binary_.nodes[node].right};
    while (children.size() < 4) {
      std::size_t best = children.size();
      float best_area = -1.0F;
      for (std::size_t i = 0; i < children.size(); ++i) {
        const BinaryNode& child = binary_.nodes[children[i]];
        if (child.count != 0) continue;
        const float area = child.height > tallest ? HUGE_VALF : half_area(child.box);
        if (area > best_area) {
          best_area = area;
          best = i;
        }
      }
      if (best == children.size()) break;
      const BinaryNode& opened = binary_.nodes[children[best]];
      children[best] = opened.left;
      children.push_back(opened.right);
    }
    return children;
  }

  std::uint32_t emit(std::uint32_t node, std::uint32_t level) {
    const auto index = static_cast<std::uint32_t>(out_.nodes.size() / kBvhNodeTexels);
    out_.nodes.resize(out_.nodes.size() + kBvhNodeTexels);
    out_.max_depth = std::max(out_.max_depth, level);
    const Children children = children_of(node, level);
    write_boxes(index, children);
    glm::uvec4 references(kBvhNoChild);
    for (std::size_t i = 0; i < children.size(); ++i) {
      const BinaryNode& child = binary_.nodes[children[i]];
      references[static_cast<int>(i)] = child.count != 0 ? kBvhLeafBit | child.first << kBvhLeafFirstShift | child.count
                                                         : emit(children[i], level + 1);
    }
    out_.nodes[index * kBvhNodeTexels + 3] = references;
    return index;
  }

  void write_boxes(std::uint32_t index, const Children& children) {
    Box all = binary_.nodes[children[0]].box;
    for (const std::uint32_t child : children) {
      all.low = glm::min(all.low, binary_.nodes[child].box.low);
      all.high = glm::max(all.high, binary_.nodes[child].box.high);
    }
    Grid grid[3];
    std::uint32_t low[3] = {0xFFFFFFFFU, 0xFFFFFFFFU, 0xFFFFFFFFU}, high[3] = {0, 0, 0};
    for (int axis = 0; axis < 3; ++axis) {
      grid[axis] = make_grid(all.low[axis], all.high[axis]);
      for (std::size_t i = 0; i < children.size(); ++i) {
        const Box& box = binary_.nodes[children[i]].box;
        const auto shift = static_cast<unsigned>(8 * i);
        low[axis] &= ~(0xFFU << shift);
        low[axis] |= grid[axis].at_or_below(box.low[axis]) << shift;
        high[axis] |= grid[axis].at_or_above(box.high[axis]) << shift;
      }
    }
    const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x); };
    glm::uvec4* q = &out_.nodes[index * kBvhNodeTexels];
    q[0] = {bits(grid[0].origin), bits(grid[1].origin), bits(grid[2].origin), bits(grid[0].scale)};
    q[1] = {bits(grid[1].scale), bits(grid[2].scale), low[0], high[0]};
    q[2] = {low[1], high[1], low[2], high[2]};
  }

  const BinaryBvh& binary_;
  Bvh4& out_;
};

}  // namespace

Bvh4 collapse_to_four(const BinaryBvh& binary) {
  Bvh4 bvh;
  Collapse(binary, bvh).run();
  return bvh;
}

}  // namespace render
