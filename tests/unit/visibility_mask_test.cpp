// What a runtime says is hidden, and what it must not be believed.
#include "xr/visibility_mask.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace {

using tracking::Side;

// A runtime of one function, which answers as the test has set it.
struct FakeMask {
  std::vector<XrVector2f> vertices{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  std::vector<std::uint32_t> indices{0, 1, 2, 0, 2, 3};
  XrResult result = XR_SUCCESS;
  bool grows = false;  // after the first question for the sizes
  std::vector<std::uint32_t> asked_views;
} fake;

XrResult XRAPI_CALL answer(XrSession /*session*/, XrViewConfigurationType configuration, std::uint32_t view,
                           XrVisibilityMaskTypeKHR type, XrVisibilityMaskKHR* mask) {
  EXPECT_EQ(configuration, XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO);
  EXPECT_EQ(type, XR_VISIBILITY_MASK_TYPE_HIDDEN_TRIANGLE_MESH_KHR);
  EXPECT_EQ(mask->type, XR_TYPE_VISIBILITY_MASK_KHR);
  fake.asked_views.push_back(view);
  mask->vertexCountOutput = static_cast<std::uint32_t>(fake.vertices.size());
  mask->indexCountOutput = static_cast<std::uint32_t>(fake.indices.size());
  const bool only_sizes = mask->vertexCapacityInput == 0 && mask->indexCapacityInput == 0;
  if (XR_FAILED(fake.result) || only_sizes) {
    if (std::exchange(fake.grows, false)) {
      fake.vertices.push_back({2, 2});
      fake.indices.insert(fake.indices.end(), {2, 3, 4});
    }
    return fake.result;
  }
  if (mask->vertexCapacityInput < fake.vertices.size() || mask->indexCapacityInput < fake.indices.size()) {
    return XR_ERROR_SIZE_INSUFFICIENT;
  }
  std::ranges::copy(fake.vertices, mask->vertices);
  std::ranges::copy(fake.indices, mask->indices);
  return XR_SUCCESS;
}

xr::HiddenView asked(const FakeMask& mask) {
  fake = mask;
  return xr::ask_hidden(answer, XR_NULL_HANDLE, Side::right);
}

TEST(VisibilityMask, TrianglesComeAsTheRuntimeGaveThem) {
  const xr::HiddenView view = asked({});
  ASSERT_EQ(view.area.triangles.size(), 2U);
  EXPECT_EQ(view.area.triangles[1][2], glm::dvec2(-1.0, 1.0));
  EXPECT_EQ(view.problem, "");
  EXPECT_EQ(fake.asked_views, (std::vector<std::uint32_t>{1, 1})) << "the right eye's view is the second";
}

TEST(VisibilityMask, AMeshThatGrowsBetweenTheQuestionsIsAskedForAgain) {
  FakeMask growing;
  growing.grows = true;
  EXPECT_EQ(asked(growing).area.triangles.size(), 3U);
}

TEST(VisibilityMask, NoTrianglesHideNothing) {
  FakeMask empty;
  empty.vertices.clear();
  empty.indices.clear();
  const xr::HiddenView view = asked(empty);
  EXPECT_TRUE(view.area.triangles.empty());
  EXPECT_EQ(view.problem, "");
}

TEST(VisibilityMask, WhatIsNoMeshHidesNothingAndIsNamed) {
  FakeMask beyond, cut, not_a_number, infinite, without_corners;
  beyond.indices.back() = 4;
  cut.indices.pop_back();
  not_a_number.vertices[2].y = std::numeric_limits<float>::quiet_NaN();
  infinite.vertices[0].x = std::numeric_limits<float>::infinity();
  without_corners.vertices.clear();
  for (const FakeMask& nonsense : {beyond, cut, not_a_number, infinite, without_corners}) {
    const xr::HiddenView view = asked(nonsense);
    EXPECT_TRUE(view.area.triangles.empty());
    EXPECT_NE(view.problem, "");
  }
}

TEST(VisibilityMask, ACallThatFailsHidesNothingAndOneThatTellsOfALossEndsTheSession) {
  FakeMask failing;
  failing.result = XR_ERROR_RUNTIME_FAILURE;
  const xr::HiddenView view = asked(failing);
  EXPECT_TRUE(view.area.triangles.empty());
  EXPECT_NE(view.problem.find("XR_ERROR_RUNTIME_FAILURE"), std::string::npos) << view.problem;
  failing.result = XR_ERROR_SESSION_LOST;
  EXPECT_THROW((void)asked(failing), xr::LostError);
}

}  // namespace
