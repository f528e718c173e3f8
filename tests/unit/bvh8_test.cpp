// The 8-wide tree: every triangle in one leaf, inside every box above it.
#include "render/scene/bvh8.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "render/scene/gpu/bvh_layout.h"
#include "tests/support/cluttered_room.hpp"
#include "tests/support/scene_oracle.hpp"

namespace {

class Walk {
 public:
  explicit Walk(render::SceneBvh bvh)
      : bvh_(std::move(bvh)), seen_(bvh_.four.triangles.size() / render::kBvhTriangleTexels) {}

  void node(std::uint32_t index, const render::Box& bounds, int depth) {
    ASSERT_LT(depth, 128);
    ASSERT_LE((index + 1) * render::kBvhWideNodeTexels, bvh_.eight.nodes.size());
    ++nodes_;
    for (std::uint32_t i = 0; i < render::kBvhWide; ++i) {
      const glm::uvec4 a = bvh_.eight.nodes[index * render::kBvhWideNodeTexels + i];
      const glm::uvec4 b = bvh_.eight.nodes[index * render::kBvhWideNodeTexels + render::kBvhWide + i];
      const render::Box box{glm::uintBitsToFloat(glm::uvec3(a)), glm::uintBitsToFloat(glm::uvec3(b))};
      if (a.w == render::kBvhNoChild) {
        EXPECT_TRUE(glm::all(glm::greaterThan(box.low, box.high))) << "nothing may enter an empty place";
        continue;
      }
      ++children_;
      EXPECT_TRUE(glm::all(glm::greaterThanEqual(box.low, bounds.low)));
      EXPECT_TRUE(glm::all(glm::lessThanEqual(box.high, bounds.high)));
      if ((a.w & render::kBvhLeafBit) != 0) {
        leaf(a.w, box);
      } else {
        node(a.w, box, depth + 1);
      }
    }
  }

  void expect_all_seen() const {
    for (const int count : seen_) EXPECT_EQ(count, 1);
    EXPECT_EQ(nodes_ * render::kBvhWideNodeTexels, bvh_.eight.nodes.size()) << "nodes that nothing leads to";
  }
  [[nodiscard]] double fill() const { return static_cast<double>(children_) / static_cast<double>(nodes_); }
  [[nodiscard]] double leaf_fill() const { return static_cast<double>(seen_.size()) / static_cast<double>(leaves_); }

 private:
  void leaf(std::uint32_t reference, const render::Box& box) {
    const std::uint32_t first = (reference >> render::kBvhLeafFirstShift) & render::kBvhLeafFirstMask;
    const std::uint32_t count = reference & render::kBvhLeafCountMask;
    EXPECT_GE(count, 1U);
    EXPECT_LE(count, render::kBvhMaxLeafTriangles);
    ++leaves_;
    for (std::uint32_t i = first; i < first + count; ++i) {
      ASSERT_LT(i, seen_.size());
      ++seen_[i];
      const auto* t = &bvh_.four.triangles[i * render::kBvhTriangleTexels];
      for (const glm::vec3& p : {glm::vec3(t[0]), glm::vec3(t[0] + t[1]), glm::vec3(t[0] + t[2])}) {
        EXPECT_TRUE(glm::all(glm::lessThan(box.low, p)) && glm::all(glm::lessThan(p, box.high)));
      }
    }
  }

  render::SceneBvh bvh_;
  std::vector<int> seen_;
  std::size_t nodes_ = 0, children_ = 0, leaves_ = 0;
};

Walk expect_sound(const render::Scene& scene) {
  Walk walk(render::build_scene_bvh(scene));
  walk.node(0, {glm::vec3(-1e30F), glm::vec3(1e30F)}, 0);
  walk.expect_all_seen();
  return walk;
}

TEST(Bvh8, HoldsOneTriangle) {
  expect_sound(scene_oracle::one_triangle());
}

TEST(Bvh8, HoldsEveryTriangleOnceInsideItsBoxes) {
  expect_sound(scene_oracle::nested_boxes());
  expect_sound(scene_oracle::far_soup(3, 5000));
  expect_sound(scene_oracle::waves(60));
}

// A node that is hardly filled wastes most invocations of its fetch; the optimal collapse fills six of eight places.
TEST(Bvh8, NodesAreWellFilled) {
  EXPECT_GT(expect_sound(support::cluttered_room(1, 30000)).fill(), 5.0);
}

// A tile pays for a leaf as a whole. Splits that heed full leaves leave 6.5 of eight places filled, others 5.
TEST(Bvh8, LeavesAreWellFilled) {
  EXPECT_GT(expect_sound(support::cluttered_room(1, 30000)).leaf_fill(), 6.0);
}

// Nodes whose boxes a line from the viewer crosses, on average of lines all around.
double nodes_crossed(const render::Bvh8& bvh, const glm::vec3& viewer) {
  constexpr int kLines = 500;
  std::size_t visits = 0;
  for (int i = 0; i < kLines; ++i) {
    const float height = 1.0F - 2.0F * (static_cast<float>(i) + 0.5F) / kLines, around = 2.4F * static_cast<float>(i);
    const float flat = std::sqrt(1.0F - height * height);
    const glm::vec3 inverse = 1.0F / glm::vec3(flat * std::cos(around), height, flat * std::sin(around));
    std::vector<std::uint32_t> open{0};
    while (!open.empty()) {
      const glm::uvec4* node = &bvh.nodes[open.back() * render::kBvhWideNodeTexels];
      open.pop_back();
      ++visits;
      for (std::uint32_t k = 0; k < render::kBvhWide; ++k) {
        const glm::vec3 one = (glm::uintBitsToFloat(glm::uvec3(node[k])) - viewer) * inverse;
        const glm::vec3 other = (glm::uintBitsToFloat(glm::uvec3(node[render::kBvhWide + k])) - viewer) * inverse;
        const glm::vec3 in = glm::min(one, other), out = glm::max(one, other);
        const float enter = std::max({in.x, in.y, in.z, 0.0F}), leave = std::min({out.x, out.y, out.z});
        if (enter <= leave && node[k].w < render::kBvhLeafBit) open.push_back(node[k].w);
      }
    }
  }
  return static_cast<double>(visits) / kLines;
}

// A room amid blocks that reach for kilometres: by their surface alone, all that is in the room is not worth a node.
TEST(Bvh8, IsShallowAroundTheViewer) {
  render::Scene scene = support::cluttered_room(1, 30000);
  for (int i = 0; i < 200; ++i) {
    const float far = 10.0F * std::exp2(static_cast<float>(i) / 20.0F), turn = static_cast<float>(i);
    scene_oracle::add_box(scene, {far * std::cos(turn), -far, far * std::sin(turn)}, glm::vec3(0.5F * far), 0);
  }
  const auto crossed = [&](const glm::vec3& start) {
    scene.cameras = {{"start", tracking::Pose{}}};
    scene.cameras[0].pose.position = start;
    return nodes_crossed(render::build_scene_bvh(scene).eight, glm::vec3(0.0F));
  };
  const double for_within = crossed(glm::vec3(0.0F)), for_afar = crossed(glm::vec3(1e7F));
  std::printf("nodes crossed: %.1f, and %.1f in a tree for a viewer far away\n", for_within, for_afar);
  EXPECT_LT(for_within, 0.95 * for_afar);
}

}  // namespace
