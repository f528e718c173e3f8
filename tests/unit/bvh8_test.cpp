// The 8-wide tree: every triangle in one leaf, inside every box above it.
#include "render/scene/bvh8.hpp"

#include <gtest/gtest.h>

#include "render/scene/gpu/bvh_layout.h"
#include "tests/support/cluttered_room.hpp"
#include "tests/support/scene_oracle.hpp"

namespace {

class Walk {
 public:
  explicit Walk(const render::SceneBvh& bvh)
      : bvh_(bvh), seen_(bvh.four.triangles.size() / render::kBvhTriangleTexels) {}

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

 private:
  void leaf(std::uint32_t reference, const render::Box& box) {
    const std::uint32_t first = (reference >> render::kBvhLeafFirstShift) & render::kBvhLeafFirstMask;
    const std::uint32_t count = reference & render::kBvhLeafCountMask;
    EXPECT_GE(count, 1U);
    EXPECT_LE(count, render::kBvhMaxLeafTriangles);
    for (std::uint32_t i = first; i < first + count; ++i) {
      ASSERT_LT(i, seen_.size());
      ++seen_[i];
      const auto* t = &bvh_.four.triangles[i * render::kBvhTriangleTexels];
      for (const glm::vec3& p : {glm::vec3(t[0]), glm::vec3(t[0] + t[1]), glm::vec3(t[0] + t[2])}) {
        EXPECT_TRUE(glm::all(glm::lessThan(box.low, p)) && glm::all(glm::lessThan(p, box.high)));
      }
    }
  }

  const render::SceneBvh& bvh_;
  std::vector<int> seen_;
  std::size_t nodes_ = 0, children_ = 0;
};

double expect_sound(const render::Scene& scene) {
  const render::SceneBvh bvh = render::build_scene_bvh(scene);
  Walk walk(bvh);
  walk.node(0, {glm::vec3(-1e30F), glm::vec3(1e30F)}, 0);
  walk.expect_all_seen();
  return walk.fill();
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
  EXPECT_GT(expect_sound(support::cluttered_room(1, 30000)), 5.0);
}

}  // namespace
