#include "render/scene/bvh8.hpp"

#include <array>
#include <bit>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <span>

#include "render/scene/gpu/bvh_layout.h"

namespace render {
namespace {

// Half the surface of a box is to the square of its distance as this to one where a tile seen from there meets it as
// often as not. Nodes visited a tile in the reading room: 21.4 by surface alone, 18.8, 17.4, 18.1 and 16.9 with 2, 4, 8
// and 25; leaves before the cars: 8.9, and 8.3, 8.3, 8.3 and 8.7.
constexpr float kNearness = 4.0F;

// How often a tile seen from `viewer` meets a box: always from within, by its surface over the square of its distance
// from afar, where this is the surface area heuristic again. That alone takes a view from within for one from outside.
float met(const Box& box, const glm::vec3& viewer) {
  const glm::vec3 d = box.high - box.low;
  const float half_area = d.x * d.y + d.y * d.z + d.z * d.x;
  const glm::vec3 apart = glm::max(glm::max(box.low - viewer, viewer - box.high), glm::vec3(0.0F));
  return half_area / (half_area + kNearness * glm::dot(apart, apart));
}

// What is best for one node of the binary tree when its subtree may take 1, 2, ... 8 places in a wide node.
struct Choice {
  std::array<float, kBvhWide> cost{};            // [places - 1]: nodes that a tile visits
  std::array<std::uint8_t, kBvhWide> to_left{};  // of these places, how many the left child gets; 0: take only one
  std::uint32_t first = 0, count = 0;            // triangles of the whole subtree
  bool leaf = false;
  std::uint8_t inside = 1;  // as a wide node: how many of the eight its left child gets
};

// Dynamic programming over the binary tree, as in Ylitie, Karras and Laine, Efficient incoherent ray traversal on GPUs
// through compressed wide BVHs (2017), section 3.
class WideTree {
 public:
  WideTree(const BinaryBvh& binary, const glm::vec3& viewer)
      : binary_(binary), viewer_(viewer), choices_(binary.nodes.size()) {
    for (std::size_t node = binary.nodes.size(); node-- > 0;) {  // children stand behind their parents
      choose(node);
    }
  }

  Bvh8 emit() {
    emit_node(0);
    return std::move(out_);
  }

 private:
  // The least cost of both children in `places`, and the left child's share of them.
  [[nodiscard]] std::pair<float, std::uint8_t> best_split(std::size_t node, std::size_t places) const {
    const Choice& left = choices_[binary_.nodes[node].left];
    const Choice& right = choices_[binary_.nodes[node].right];
    std::pair<float, std::uint8_t> best{std::numeric_limits<float>::infinity(), std::uint8_t{1}};
    for (std::size_t i = 1; i < places; ++i) {
      const float cost = left.cost[i - 1] + right.cost[places - i - 1];
      if (cost < best.first) {
        best = {cost, static_cast<std::uint8_t>(i)};
      }
    }
    return best;
  }

  void choose(std::size_t index) {
    const BinaryNode& node = binary_.nodes[index];
    Choice& choice = choices_[index];
    const bool inner = node.count == 0;
    choice.first = inner ? choices_[node.left].first : node.first;
    choice.count = inner ? choices_[node.left].count + choices_[node.right].count : node.count;
    // A tile pays for a leaf as a whole, whatever it holds: its triangles are tested against the tile's bounds side by
    // side. So leaves are as full as the tree lets them be, and cost the same whatever is chosen above them.
    choice.leaf = choice.count <= kBvhMaxLeafTriangles;
    if (choice.leaf) {
      return;
    }
    const auto [inside_cost, inside] = best_split(index, kBvhWide);
    choice.inside = inside;
    choice.cost[0] = met(node.box, viewer_) + inside_cost;
    for (std::size_t places = 2; places <= kBvhWide; ++places) {
      const auto [cost, share] = best_split(index, places);
      const bool split = cost < choice.cost[0];
      choice.cost[places - 1] = split ? cost : choice.cost[0];
      choice.to_left[places - 1] = split ? share : std::uint8_t{0};
    }
  }

  void gather(std::uint32_t node, std::uint8_t places, std::vector<std::uint32_t>& children) const {
    const std::uint8_t share = choices_[node].to_left[places - 1U];
    if (share == 0) {
      children.push_back(node);
      return;
    }
    gather(binary_.nodes[node].left, share, children);
    gather(binary_.nodes[node].right, static_cast<std::uint8_t>(places - share), children);
  }

  [[nodiscard]] std::vector<std::uint32_t> children_of(std::uint32_t node) const {
    if (choices_[node].leaf) {
      return {node};  // a root that is a leaf
    }
    std::vector<std::uint32_t> children;
    gather(binary_.nodes[node].left, choices_[node].inside, children);
    gather(binary_.nodes[node].right, static_cast<std::uint8_t>(kBvhWide - choices_[node].inside), children);
    return children;
  }

  // Depth first; the binary tree bounds the recursion.
  std::uint32_t emit_node(std::uint32_t node) {
    const std::size_t base = out_.nodes.size();
    const float far = std::numeric_limits<float>::max();
    const auto bits = [](const glm::vec3& v, std::uint32_t w) {
      return glm::uvec4(std::bit_cast<std::uint32_t>(v.x), std::bit_cast<std::uint32_t>(v.y),
                        std::bit_cast<std::uint32_t>(v.z), w);
    };
    out_.nodes.insert(out_.nodes.end(), kBvhWide, bits(glm::vec3(far), kBvhNoChild));
    out_.nodes.insert(out_.nodes.end(), kBvhWide, bits(glm::vec3(-far), 0));
    const std::vector<std::uint32_t> children = children_of(node);
    for (std::size_t i = 0; i < children.size(); ++i) {
      const Choice& child = choices_[children[i]];
      const std::uint32_t reference =
          child.leaf ? kBvhLeafBit | child.first << kBvhLeafFirstShift | child.count : emit_node(children[i]);
      out_.nodes[base + i] = bits(binary_.nodes[children[i]].box.low, reference);
      out_.nodes[base + kBvhWide + i] = bits(binary_.nodes[children[i]].box.high, 0);
    }
    return static_cast<std::uint32_t>(base / kBvhWideNodeTexels);
  }

  const BinaryBvh& binary_;
  glm::vec3 viewer_;
  std::vector<Choice> choices_;
  Bvh8 out_;
};

}  // namespace

Bvh8 collapse_to_eight(const BinaryBvh& binary, const glm::vec3& viewer) {
  return WideTree(binary, viewer).emit();
}

}  // namespace render
