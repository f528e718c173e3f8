// The gaze layer in the real loader's chain over a real Monado, asked by plain OpenXR calls as any program asks.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>

#include "tests/support/gaze_program.hpp"
#include "tests/support/gaze_wearer.hpp"
#include "xr/gaze_input.hpp"

namespace {

using support::gaze_row;
using support::GazeProgram;
using support::kFloatPose;
using support::kTrackedBits;
using support::kValidBits;
using support::nanoseconds;
using support::yaw;

// Straight ahead for 1 s, 20 degrees to the right for 1 s, a blink, then down.
std::string three_looks() {
  return gaze_row(5.0, yaw(0), yaw(0)) + gaze_row(6.0, yaw(20), yaw(20)) + gaze_row(7.0, yaw(0), yaw(0), false) +
         gaze_row(7.2, yaw(0, -30), yaw(0, -30));
}

class GazeLayer : public testing::Test {
 protected:
  GazeLayer() { support::enable_layers(support::kGazeLayer); }
  support::Monado monado_;
};

TEST_F(GazeLayer, GivesTheTraceAtTheTimesAskedFor) {
  const support::TraceFile trace(monado_, three_looks());
  GazeProgram program;
  EXPECT_FALSE(program.is_active());
  EXPECT_EQ(program.gaze(program.now()).flags, 0U) << "before the focus";
  program.wait_for_focus();
  EXPECT_TRUE(program.is_active());
  const XrTime start = program.now();
  const auto look = [&](double at, const glm::dvec3& direction, double sample) {
    const auto gaze = program.gaze(start + nanoseconds(at));
    EXPECT_EQ(gaze.flags, kValidBits | kTrackedBits) << at;
    EXPECT_LT(glm::length(gaze.direction - direction), kFloatPose) << at;
    EXPECT_EQ(gaze.sample_time, start + nanoseconds(sample)) << at;
  };
  look(0.0, yaw(0), 0.0);
  look(0.999, yaw(0), 0.0);
  look(1.0, yaw(20), 1.0);
  look(1.5, yaw(20), 1.0);
  EXPECT_EQ(program.gaze(start + nanoseconds(2.1)).flags, 0U) << "in a blink";
  EXPECT_EQ(program.gaze(start + nanoseconds(2.1)).sample_time, 0);
  EXPECT_TRUE(program.is_active()) << "a blink does not take the tracker away";
  look(2.5, yaw(0, -30), 2.5);  // the end is held, and counts as seen anew
}

TEST_F(GazeLayer, StandsInTheLoadersListWithBothExtensions) {
  std::uint32_t count = 0;
  ASSERT_EQ(xrEnumerateApiLayerProperties(0, &count, nullptr), XR_SUCCESS);
  std::vector<XrApiLayerProperties> layers(count, {XR_TYPE_API_LAYER_PROPERTIES, nullptr, {}, 0, 0, {}});
  ASSERT_EQ(xrEnumerateApiLayerProperties(count, &count, layers.data()), XR_SUCCESS);
  EXPECT_TRUE(std::ranges::any_of(
      layers, [](const XrApiLayerProperties& layer) { return std::string(layer.layerName) == support::kGazeLayer; }));
  ASSERT_EQ(xrEnumerateInstanceExtensionProperties(support::kGazeLayer, 0, &count, nullptr), XR_SUCCESS);
  EXPECT_EQ(count, 2U);
  const xr::Instance instance({.application = "gaze test", .wanted_extensions = xr::gaze_extensions()});
  EXPECT_TRUE(instance.has(XR_EXT_EYE_GAZE_INTERACTION_EXTENSION_NAME));
  EXPECT_TRUE(instance.has(XR_FB_EYE_TRACKING_SOCIAL_EXTENSION_NAME));
}

TEST_F(GazeLayer, SupportsGazeOnlyWithASource) {
  const auto support = [] {
    const xr::Instance instance({.application = "gaze test", .wanted_extensions = xr::gaze_extensions()});
    return xr::gaze_support(instance);
  };
  EXPECT_FALSE(support().combined);
  EXPECT_FALSE(support().per_eye);
  const support::TraceFile trace(monado_, three_looks());
  EXPECT_TRUE(support().combined);
  EXPECT_TRUE(support().per_eye);
  // Without the layer the same runtime has neither.
  setenv("XR_ENABLE_API_LAYERS", "", 1);
  EXPECT_FALSE(support().combined);
  EXPECT_FALSE(support().per_eye);
}

// Where layers are on by themselves, this one is where the user's environment says so.
TEST_F(GazeLayer, IsFoundAsAnImplicitLayer) {
  setenv("XR_ENABLE_API_LAYERS", "", 1);
  unsetenv("XR_API_LAYER_PATH");
  const auto folder = monado_.folder() / "openxr/1/api_layers/implicit.d";
  std::filesystem::create_directories(folder);
  std::filesystem::copy(VERGENCE_GAZE_LAYER "/implicit/XR_APILAYER_VERGENCE_gaze.json", folder);
  setenv("XDG_DATA_HOME", monado_.folder().c_str(), 1);
  const support::TraceFile trace(monado_, three_looks());
  const auto support = [] {
    return xr::gaze_support(xr::Instance({.application = "gaze test", .wanted_extensions = xr::gaze_extensions()}));
  };
  EXPECT_FALSE(support().combined);
  setenv("VERGENCE_GAZE", "1", 1);
  EXPECT_TRUE(support().combined);
  // By name as well: it is there once.
  setenv("XR_API_LAYER_PATH", VERGENCE_GAZE_LAYER, 1);
  setenv("XR_ENABLE_API_LAYERS", support::kGazeLayer, 1);
  EXPECT_TRUE(support().combined);
  setenv("XR_ENABLE_API_LAYERS", "", 1);
  setenv("VERGENCE_GAZE_DISABLE", "1", 1);
  EXPECT_FALSE(support().combined);
}

TEST_F(GazeLayer, FollowsTheHeadIntoAnySpace) {
  const support::TraceFile trace(monado_, gaze_row(0.0, yaw(10, 5), yaw(10, 5)));
  GazeProgram program;
  program.wait_for_focus();
  // 1 m along the gaze and turned a quarter about it.
  const XrSpace offset = program.action_space({{0.0F, 0.0F, 0.70710678F, 0.70710678F}, {0.0F, 0.0F, -1.0F}});
  for (int i = 0; i < 20; ++i) {
    const XrTime time = program.now() + nanoseconds(0.05 * i);
    const auto head = program.locate(program.view.handle(), program.local.handle(), time);
    const auto in_head = program.gaze(time);
    const auto in_local = program.locate(program.gaze_space, program.local.handle(), time);
    EXPECT_LT(glm::length(in_local.direction - head.base_from_space.direction(yaw(10, 5))), kFloatPose);
    EXPECT_LT(glm::length(in_local.base_from_space.position - head.base_from_space.position), kFloatPose);
    const auto point = program.locate(offset, program.local.handle(), time);
    EXPECT_LT(glm::length(point.base_from_space.position - head.base_from_space.point(yaw(10, 5))), kFloatPose);
    const tracking::Pose turned =
        in_head.base_from_space.inverse() * program.locate(offset, program.view.handle(), time).base_from_space;
    EXPECT_LT(glm::length(turned.direction({1.0, 0.0, 0.0}) - glm::dvec3(0.0, 1.0, 0.0)), kFloatPose);
    // The other way round: where the space lies as the gaze sees it.
    const auto back = program.locate(program.local.handle(), program.gaze_space, time);
    // The simulated headset tracks its orientation only, and a gaze pose is tracked as a whole or not at all.
    EXPECT_EQ(in_local.flags, kValidBits);
    EXPECT_EQ(back.flags, kValidBits);
    const tracking::Pose there_and_back = in_local.base_from_space * back.base_from_space;
    EXPECT_LT(glm::length(there_and_back.position), 2.0 * kFloatPose);
    EXPECT_LT(glm::length(there_and_back.direction({0.0, 0.0, -1.0}) - glm::dvec3(0.0, 0.0, -1.0)), 2.0 * kFloatPose);
    // And from one gaze space to another, in which the head has no part.
    const auto between = program.locate(offset, program.gaze_space, time);
    EXPECT_LT(glm::length(between.base_from_space.position - glm::dvec3(0.0, 0.0, -1.0)), kFloatPose);
  }
  xrDestroySpace(offset);
}

TEST_F(GazeLayer, LocatesManySpacesInOneCall) {
  const support::TraceFile trace(monado_, gaze_row(0.0, yaw(10, 5), yaw(10, 5)));
  GazeProgram program;
  program.wait_for_focus();
  const XrTime time = program.now();
  const std::array<XrSpace, 2> spaces{program.view.handle(), program.gaze_space};
  const XrSpacesLocateInfoKHR info{
      XR_TYPE_SPACES_LOCATE_INFO_KHR, nullptr, program.local.handle(), time, 2, spaces.data()};
  std::array<XrSpaceLocationDataKHR, 2> data{};
  XrSpaceLocationsKHR locations{XR_TYPE_SPACE_LOCATIONS_KHR, nullptr, 2, data.data()};
  const auto locate = program.instance.function<PFN_xrLocateSpacesKHR>("xrLocateSpacesKHR");
  ASSERT_EQ(locate(program.session.handle(), &info, &locations), XR_SUCCESS);
  EXPECT_EQ(data[1].locationFlags, kValidBits);
  const glm::dvec3 expected = xr::pose_of(data[0].pose).direction(yaw(10, 5));
  EXPECT_LT(glm::length(xr::pose_of(data[1].pose).direction({0.0, 0.0, -1.0}) - expected), kFloatPose);
}

TEST_F(GazeLayer, AnswersWhereTheGazeComesFrom) {
  const support::TraceFile trace(monado_, three_looks());
  GazeProgram program;
  program.wait_for_focus();
  const XrSession session = program.session.handle();
  const auto text = [&](XrPath path) {
    std::uint32_t count = 0;
    std::array<char, XR_MAX_PATH_LENGTH> buffer{};
    xr::check(xrPathToString(program.instance.handle(), path, XR_MAX_PATH_LENGTH, &count, buffer.data()),
              "xrPathToString");
    return std::string(buffer.data());
  };
  XrInteractionProfileState profile{XR_TYPE_INTERACTION_PROFILE_STATE, nullptr, XR_NULL_PATH};
  ASSERT_EQ(xrGetCurrentInteractionProfile(session, program.instance.path("/user/eyes_ext"), &profile), XR_SUCCESS);
  EXPECT_EQ(text(profile.interactionProfile), "/interaction_profiles/ext/eye_gaze_interaction");
  const XrBoundSourcesForActionEnumerateInfo info{XR_TYPE_BOUND_SOURCES_FOR_ACTION_ENUMERATE_INFO, nullptr,
                                                  program.pose};
  std::uint32_t count = 0;
  ASSERT_EQ(xrEnumerateBoundSourcesForAction(session, &info, 0, &count, nullptr), XR_SUCCESS);
  ASSERT_EQ(count, 1U);
  XrPath source = XR_NULL_PATH;
  ASSERT_EQ(xrEnumerateBoundSourcesForAction(session, &info, 1, &count, &source), XR_SUCCESS);
  EXPECT_EQ(text(source), "/user/eyes_ext/input/gaze_ext/pose");
  const XrInputSourceLocalizedNameGetInfo name_info{XR_TYPE_INPUT_SOURCE_LOCALIZED_NAME_GET_INFO, nullptr, source,
                                                    XR_INPUT_SOURCE_LOCALIZED_NAME_COMPONENT_BIT};
  std::array<char, 64> name{};
  ASSERT_EQ(xrGetInputSourceLocalizedName(session, &name_info, 4, &count, name.data()), XR_ERROR_SIZE_INSUFFICIENT);
  ASSERT_EQ(xrGetInputSourceLocalizedName(session, &name_info, name.size(), &count, name.data()), XR_SUCCESS);
  EXPECT_STREQ(name.data(), "Eye gaze");
  program.poll();
  EXPECT_NE(std::ranges::find(program.events, XR_TYPE_EVENT_DATA_INTERACTION_PROFILE_CHANGED), program.events.end());
}

// A trace that cannot be read costs the program its gaze and nothing else; the user is told why, once.
TEST_F(GazeLayer, IsBlindWithADamagedTrace) {
  for (const char* damaged :
       {"1,2,3\n", "0,0,0,0,0,0,0,1,0,0,-1,0,0,x,1\n", "0,0,0,0,0,0,0,1,0,0,nan,0,0,-1,1\n", "",
        "1,0,0,0,0,0,0,1,0,0,-1,0,0,-1,1\n0,0,0,0,0,0,0,1,0,0,-1,0,0,-1,1\n", "0,0,0,0,0,0,0,1,0,0,0,0,0,0,1\n"}) {
    const support::TraceFile trace(monado_, damaged);
    testing::internal::CaptureStderr();
    {
      GazeProgram program;
      program.wait_for_focus();
      EXPECT_FALSE(program.is_active());
      EXPECT_EQ(program.gaze(program.now()).flags, 0U);
    }
    const std::string said = testing::internal::GetCapturedStderr();
    const auto first = said.find("XR_APILAYER_VERGENCE_gaze: ");
    ASSERT_NE(first, std::string::npos) << damaged;
    EXPECT_NE(said.find("trace.csv", first), std::string::npos) << said;
    EXPECT_EQ(said.find("XR_APILAYER_VERGENCE_gaze: ", first + 1), std::string::npos) << said;
  }
}

TEST_F(GazeLayer, OutlivesTheRuntime) {
  const support::TraceFile trace(monado_, three_looks());
  {
    GazeProgram program;
    program.wait_for_focus();
    const XrTime now = program.now();
    ASSERT_NE(program.gaze(now).flags, 0U);
    monado_.kill();
    EXPECT_THROW(program.poll(), xr::LostError);  // a runtime notices its loss when it is asked for events
    XrSpaceLocation location{XR_TYPE_SPACE_LOCATION, nullptr, 0, xr::kIdentityPose};
    const XrSpace local = program.local.handle();
    const XrResult its_own = xrLocateSpace(program.view.handle(), local, now + 1, &location);
    ASSERT_TRUE(XR_FAILED(its_own));
    EXPECT_EQ(xrLocateSpace(program.gaze_space, local, now + 1, &location), its_own);
  }
  monado_.start();
  GazeProgram again;
  again.wait_for_focus();
  EXPECT_EQ(again.gaze(again.now()).flags, kValidBits | kTrackedBits);
}

std::ptrdiff_t entries_of(const char* folder) {
  return std::distance(std::filesystem::directory_iterator(folder), {});
}

// Threads and files of the layer go with its instance.
TEST_F(GazeLayer, LeavesNothingBehindAfterManySessions) {
  setenv("VERGENCE_GAZE_SOCKET", (monado_.folder() / "nobody").c_str(), 1);
  std::ptrdiff_t files = 0, threads = 0;
  for (int i = 0; i < 20; ++i) {
    {
      support::GazeWearer wearer;
      wearer.wait_for_focus();
      EXPECT_FALSE(wearer.read(wearer.now()).valid);
    }
    if (i == 1) {  // what loader and runtime keep for good is there by now
      files = entries_of("/proc/self/fd");
      threads = entries_of("/proc/self/task");
    }
  }
  EXPECT_EQ(entries_of("/proc/self/fd"), files);
  EXPECT_EQ(entries_of("/proc/self/task"), threads);
}

// What the OpenXR validation layer says of all that a program does, for either order in the chain: above, it sees what
// the gaze layer answers; below, what the gaze layer asks.
class ValidatedGazeLayer : public GazeLayer, public testing::WithParamInterface<const char*> {
 protected:
  ValidatedGazeLayer() {
    setenv("XR_CORE_VALIDATION_EXPORT_TYPE", "text", 1);
    setenv("XR_CORE_VALIDATION_FILE_NAME", said_.c_str(), 1);
    support::enable_layers(GetParam());
  }
  // But for newer layers' notes of their own beginning and end.
  [[nodiscard]] std::string said() const {
    std::string text;
    std::ifstream file(said_);
    for (std::string line; std::getline(file, line);) {
      if (line.find("VALID_DEBUG") == std::string::npos) {
        text += line + "\n";
      }
    }
    return text;
  }
  std::filesystem::path said_ = monado_.folder() / "validation.txt";
};

INSTANTIATE_TEST_SUITE_P(Chain, ValidatedGazeLayer,
                         testing::Values("XR_APILAYER_LUNARG_core_validation:XR_APILAYER_VERGENCE_gaze",
                                         "XR_APILAYER_VERGENCE_gaze:XR_APILAYER_LUNARG_core_validation"),
                         [](const auto& chain) { return chain.index == 0 ? "Above" : "Below"; });

TEST_P(ValidatedGazeLayer, SaysNothing) {
  const support::TraceFile trace(monado_, three_looks());
  {
    GazeProgram program;
    program.wait_for_focus();
    EXPECT_TRUE(program.is_active());
    const XrTime now = program.now();
    EXPECT_EQ(program.gaze(now).flags, kValidBits | kTrackedBits);
    EXPECT_EQ(program.locate(program.local.handle(), program.gaze_space, now).flags, kValidBits);
  }
  {
    // A validation layer as old as 1.0.20 does not know eye tracking and refuses its structures before anybody below
    // sees them.
    const bool above = std::string(GetParam()).starts_with("XR_APILAYER_LUNARG");
    support::GazeWearer wearer(above ? std::vector<std::string>{XR_EXT_EYE_GAZE_INTERACTION_EXTENSION_NAME}
                                     : xr::gaze_extensions());
    wearer.wait_for_focus();
    EXPECT_TRUE(wearer.read(wearer.now()).valid);
  }
  {
    GazeProgram program;
    program.wait_for_focus();
    const XrTime now = program.now();
    EXPECT_EQ(said(), "");
    XrSpaceLocation wrong{};
    EXPECT_EQ(xrLocateSpace(program.view.handle(), program.local.handle(), now, &wrong), XR_ERROR_VALIDATION_FAILURE);
    EXPECT_NE(said(), "") << "the validation layer is not at work";
  }
}

}  // namespace
