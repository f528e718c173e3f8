// The gaze layer's own functions over a runtime that writes down what it is told.
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <thread>

#include "tests/support/fake_runtime.hpp"
#include "xr/layer/handles.hpp"

namespace {

using namespace xr::layer;
namespace fake = support::fake;

constexpr const char* kGaze = XR_EXT_EYE_GAZE_INTERACTION_EXTENSION_NAME;
constexpr const char* kEyes = XR_FB_EYE_TRACKING_SOCIAL_EXTENSION_NAME;
constexpr const char* kTimespec = XR_KHR_CONVERT_TIMESPEC_TIME_EXTENSION_NAME;
constexpr XrTime kNow = 1'000'000'000;

XrNegotiateLoaderInfo loader_info() {
  return {XR_LOADER_INTERFACE_STRUCT_LOADER_INFO, XR_LOADER_INFO_STRUCT_VERSION, sizeof(XrNegotiateLoaderInfo),   1,
          XR_CURRENT_LOADER_API_LAYER_VERSION,    XR_MAKE_VERSION(1, 0, 0),      XR_MAKE_VERSION(1, 0x3ff, 0xfff)};
}

XrNegotiateApiLayerRequest blank_request() {
  XrNegotiateApiLayerRequest request{};
  request.structType = XR_LOADER_INTERFACE_STRUCT_API_LAYER_REQUEST;
  request.structVersion = XR_API_LAYER_INFO_STRUCT_VERSION;
  request.structSize = sizeof(request);
  return request;
}

TEST(GazeLayerNegotiation, AgreesWithALoaderOfItsInterface) {
  const auto info = loader_info();
  auto request = blank_request();
  ASSERT_EQ(xrNegotiateLoaderApiLayerInterface(&info, kLayerName, &request), XR_SUCCESS);
  EXPECT_EQ(request.layerInterfaceVersion, 1U);
  EXPECT_EQ(XR_VERSION_MAJOR(request.layerApiVersion), 1U);
  EXPECT_NE(request.getInstanceProcAddr, nullptr);
  EXPECT_NE(request.createApiLayerInstance, nullptr);
}

TEST(GazeLayerNegotiation, RefusesWhatItDoesNotKnow) {
  const auto refuses = [](auto change) {
    auto info = loader_info();
    auto request = blank_request();
    change(info, request);
    return xrNegotiateLoaderApiLayerInterface(&info, kLayerName, &request) == XR_ERROR_INITIALIZATION_FAILED &&
           request.getInstanceProcAddr == nullptr;
  };
  EXPECT_TRUE(refuses([](auto& info, auto&) { info.structType = XR_LOADER_INTERFACE_STRUCT_API_LAYER_REQUEST; }));
  EXPECT_TRUE(refuses([](auto& info, auto&) { info.structVersion = 2; }));
  EXPECT_TRUE(refuses([](auto& info, auto&) { info.structSize -= 4; }));
  EXPECT_TRUE(refuses([](auto& info, auto&) { info.minInterfaceVersion = info.maxInterfaceVersion = 2; }));
  EXPECT_TRUE(refuses([](auto& info, auto&) { info.minApiVersion = XR_MAKE_VERSION(2, 0, 0); }));
  EXPECT_TRUE(refuses([](auto&, auto& request) { request.structSize += 4; }));
  EXPECT_TRUE(refuses([](auto&, auto& request) { request.structVersion = 0; }));
  const auto info = loader_info();
  auto request = blank_request();
  EXPECT_EQ(xrNegotiateLoaderApiLayerInterface(&info, "XR_APILAYER_other", &request), XR_ERROR_INITIALIZATION_FAILED);
  EXPECT_EQ(xrNegotiateLoaderApiLayerInterface(nullptr, kLayerName, &request), XR_ERROR_INITIALIZATION_FAILED);
  EXPECT_EQ(xrNegotiateLoaderApiLayerInterface(&info, kLayerName, nullptr), XR_ERROR_INITIALIZATION_FAILED);
}

// An instance of the layer over the fake, with a trace that looks 20 degrees down and to the right.
class GazeLayerChain : public testing::Test {
 protected:
  GazeLayerChain() {
    std::ofstream(trace_) << "time_s,head_px,head_py,head_pz,head_qx,head_qy,head_qz,head_qw,left_gx,left_gy,left_gz,"
                             "right_gx,right_gy,right_gz,gaze_valid\n0,0,0,0,0,0,0,1,0.3,-0.4,-1,0.3,-0.4,-1,1\n";
    setenv("VERGENCE_GAZE_TRACE", trace_.c_str(), 1);
    for (const char* name : {"VERGENCE_GAZE_SOCKET", "VERGENCE_GAZE_END", "VERGENCE_GAZE_FORCE"}) {
      unsetenv(name);
    }
  }
  ~GazeLayerChain() override {
    if (instance_ != XR_NULL_HANDLE) {
      call<PFN_xrDestroyInstance>("xrDestroyInstance")(instance_);
    }
    // Whatever a program leaves behind, the layer does not.
    EXPECT_EQ(handles().instances.size() + handles().sessions.size() + handles().action_sets.size() +
                  handles().actions.size() + handles().spaces.size() + handles().eye_trackers.size(),
              0U);
    EXPECT_EQ(runtime_.live_instances, 0);
    std::filesystem::remove(trace_);
  }

  XrResult create(const std::vector<const char*>& extensions) {
    XrInstanceCreateInfo info{};
    info.type = XR_TYPE_INSTANCE_CREATE_INFO;
    info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    info.enabledExtensionNames = extensions.data();
    XrApiLayerNextInfo next{XR_LOADER_INTERFACE_STRUCT_API_LAYER_NEXT_INFO,
                            XR_API_LAYER_NEXT_INFO_STRUCT_VERSION,
                            sizeof(XrApiLayerNextInfo),
                            {},
                            fake::get_instance_proc_addr,
                            fake::create_instance,
                            nullptr};
    std::strcpy(next.layerName, kLayerName);
    XrApiLayerCreateInfo layer{XR_LOADER_INTERFACE_STRUCT_API_LAYER_CREATE_INFO,
                               XR_API_LAYER_CREATE_INFO_STRUCT_VERSION,
                               sizeof(XrApiLayerCreateInfo),
                               nullptr,
                               {},
                               &next};
    return create_instance(&info, &layer, &instance_);
  }

  template <class F>
  F call(const char* name) {
    PFN_xrVoidFunction function = nullptr;
    get_instance_proc_addr(instance_, name, &function);
    return reinterpret_cast<F>(function);
  }

  XrPath path(const char* text) { return runtime_.path(text); }
  XrPath eyes() { return path("/user/eyes_ext"); }
  XrPath profile() { return path("/interaction_profiles/ext/eye_gaze_interaction"); }
  XrPath gaze_pose() { return path("/user/eyes_ext/input/gaze_ext/pose"); }

  XrSession make_session() {
    const XrSessionCreateInfo info{XR_TYPE_SESSION_CREATE_INFO, nullptr, 0, 1};
    XrSession session = XR_NULL_HANDLE;
    EXPECT_EQ(create_session(instance_, &info, &session), XR_SUCCESS);
    return session;
  }

  void enter(XrSession session, XrSessionState state) {
    runtime_.tell_state(session, state);
    XrEventDataBuffer event{};
    EXPECT_EQ(poll_event(instance_, &event), XR_SUCCESS);
    EXPECT_EQ(event.type, XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED);
  }

  void make_action(std::vector<XrPath> subactions = {}) {
    const XrActionSetCreateInfo set_info{XR_TYPE_ACTION_SET_CREATE_INFO, nullptr, "set", "Set", 0};
    ASSERT_EQ(create_action_set(instance_, &set_info, &set_), XR_SUCCESS);
    XrActionCreateInfo info{};
    info.type = XR_TYPE_ACTION_CREATE_INFO;
    info.actionType = XR_ACTION_TYPE_POSE_INPUT;
    info.countSubactionPaths = static_cast<std::uint32_t>(subactions.size());
    info.subactionPaths = subactions.data();
    ASSERT_EQ(create_action(set_, &info, &action_), XR_SUCCESS);
  }

  XrResult suggest(XrPath to_profile, XrPath binding) {
    const XrActionSuggestedBinding suggested{action_, binding};
    const XrInteractionProfileSuggestedBinding info{XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING, nullptr, to_profile,
                                                    1, &suggested};
    return suggest_interaction_profile_bindings(instance_, &info);
  }

  void attach_and_sync(XrSession session, XrPath subaction = XR_NULL_PATH) {
    const XrSessionActionSetsAttachInfo attach_info{XR_TYPE_SESSION_ACTION_SETS_ATTACH_INFO, nullptr, 1, &set_};
    ASSERT_EQ(attach_session_action_sets(session, &attach_info), XR_SUCCESS);
    resync(session, subaction);
  }

  XrResult resync(XrSession session, XrPath subaction = XR_NULL_PATH) {
    const XrActiveActionSet active{set_, subaction};
    const XrActionsSyncInfo sync_info{XR_TYPE_ACTIONS_SYNC_INFO, nullptr, 1, &active};
    return sync_actions(session, &sync_info);
  }

  XrSpace make_space(XrSession session, XrPath subaction = XR_NULL_PATH) {
    const XrActionSpaceCreateInfo info{XR_TYPE_ACTION_SPACE_CREATE_INFO, nullptr, action_, subaction,
                                       xr::kIdentityPose};
    XrSpace space = XR_NULL_HANDLE;
    EXPECT_EQ(create_action_space(session, &info, &space), XR_SUCCESS);
    return space;
  }

  XrSpaceLocation locate(XrSpace space, XrTime time = kNow) {
    XrSpaceLocation location{XR_TYPE_SPACE_LOCATION, nullptr, 0, xr::kIdentityPose};
    EXPECT_EQ(locate_space(space, kBase, time, &location), XR_SUCCESS);
    return location;
  }

  bool is_active(XrSession session, XrPath subaction = XR_NULL_PATH) {
    const XrActionStateGetInfo info{XR_TYPE_ACTION_STATE_GET_INFO, nullptr, action_, subaction};
    XrActionStatePose state{XR_TYPE_ACTION_STATE_POSE, nullptr, XR_FALSE};
    EXPECT_EQ(get_action_state_pose(session, &info, &state), XR_SUCCESS);
    return state.isActive != XR_FALSE;
  }

  // A session in the focus with a gaze action that is bound and synced.
  XrSession focused_session(std::vector<XrPath> subactions = {}) {
    const XrSession session = make_session();
    make_action(std::move(subactions));
    EXPECT_EQ(suggest(profile(), gaze_pose()), XR_SUCCESS);
    attach_and_sync(session);
    enter(session, XR_SESSION_STATE_FOCUSED);
    return session;
  }

  static inline const XrSpace kBase = reinterpret_cast<XrSpace>(0x20);
  static inline const glm::dvec3 kLook = glm::normalize(glm::dvec3(0.3, -0.4, -1.0));

  std::filesystem::path trace_ =
      std::filesystem::temp_directory_path() / ("vergence-chain-" + std::to_string(getpid()) + ".csv");
  support::FakeRuntime runtime_;
  XrInstance instance_ = XR_NULL_HANDLE;
  XrActionSet set_ = XR_NULL_HANDLE;
  XrAction action_ = XR_NULL_HANDLE;
};

TEST_F(GazeLayerChain, KeepsFromTheRuntimeWhatItDoesNotKnow) {
  ASSERT_EQ(create({kGaze, XR_MND_HEADLESS_EXTENSION_NAME, kEyes}), XR_SUCCESS);
  EXPECT_EQ(runtime_.enabled, (std::vector<std::string>{XR_MND_HEADLESS_EXTENSION_NAME, kTimespec}));
  XrSystemEyeTrackingPropertiesFB of_eyes{XR_TYPE_SYSTEM_EYE_TRACKING_PROPERTIES_FB, nullptr, XR_FALSE};
  XrSystemHandTrackingPropertiesEXT of_hands{XR_TYPE_SYSTEM_HAND_TRACKING_PROPERTIES_EXT, &of_eyes, XR_FALSE};
  XrSystemEyeGazeInteractionPropertiesEXT of_gaze{XR_TYPE_SYSTEM_EYE_GAZE_INTERACTION_PROPERTIES_EXT, &of_hands,
                                                  XR_FALSE};
  XrSystemProperties properties{};
  properties.type = XR_TYPE_SYSTEM_PROPERTIES;
  properties.next = &of_gaze;
  ASSERT_EQ(get_system_properties(instance_, 1, &properties), XR_SUCCESS);
  EXPECT_EQ(runtime_.system_chain, std::vector{XR_TYPE_SYSTEM_HAND_TRACKING_PROPERTIES_EXT});
  EXPECT_TRUE(of_gaze.supportsEyeGazeInteraction);
  EXPECT_TRUE(of_eyes.supportsEyeTracking);
  // The program's chain is as it was.
  EXPECT_EQ(properties.next, &of_gaze);
  EXPECT_EQ(of_gaze.next, &of_hands);
  EXPECT_EQ(of_hands.next, &of_eyes);
}

TEST_F(GazeLayerChain, StandsAsideForAProgramWithoutGaze) {
  ASSERT_EQ(create({XR_MND_HEADLESS_EXTENSION_NAME}), XR_SUCCESS);
  EXPECT_EQ(runtime_.enabled, std::vector<std::string>{XR_MND_HEADLESS_EXTENSION_NAME});
  EXPECT_EQ(call<PFN_xrLocateSpace>("xrLocateSpace"), &fake::locate_space);
  EXPECT_EQ(call<PFN_xrPollEvent>("xrPollEvent"), &fake::poll_event);
  EXPECT_EQ(call<PFN_xrCreateEyeTrackerFB>("xrCreateEyeTrackerFB"), nullptr);
}

TEST_F(GazeLayerChain, AnswersForTheEyesPathsThatTheRuntimeWouldRefuse) {
  ASSERT_EQ(create({kGaze}), XR_SUCCESS);
  const XrSession session = make_session();
  const XrPath right = path("/user/hand/right");
  make_action({right, eyes()});
  EXPECT_EQ(runtime_.subaction_paths, std::vector{right});
  EXPECT_EQ(suggest(profile(), path("/user/eyes_ext/input/blink/click")), XR_ERROR_PATH_UNSUPPORTED);
  EXPECT_EQ(suggest(profile(), gaze_pose()), XR_SUCCESS);
  EXPECT_TRUE(runtime_.suggested_profiles.empty());
  XrInteractionProfileState state{XR_TYPE_INTERACTION_PROFILE_STATE, nullptr, 123};
  EXPECT_EQ(get_current_interaction_profile(session, eyes(), &state), XR_ERROR_ACTIONSET_NOT_ATTACHED);
  attach_and_sync(session, eyes());
  EXPECT_EQ(runtime_.synced_sets, 0U);
  EXPECT_EQ(suggest(profile(), gaze_pose()), XR_ERROR_ACTIONSETS_ALREADY_ATTACHED);
  EXPECT_EQ(get_current_interaction_profile(session, eyes(), &state), XR_SUCCESS);
  EXPECT_EQ(state.interactionProfile, profile());
  EXPECT_EQ(get_current_interaction_profile(session, right, &state), XR_SUCCESS);
  EXPECT_NE(state.interactionProfile, profile());
  enter(session, XR_SESSION_STATE_FOCUSED);
  const XrSpace space = make_space(session, eyes());
  EXPECT_EQ(runtime_.space_subaction, static_cast<XrPath>(XR_NULL_PATH));
  EXPECT_TRUE(is_active(session, eyes()));
  EXPECT_EQ(runtime_.state_subaction, static_cast<XrPath>(XR_NULL_PATH));
  EXPECT_FALSE(is_active(session, right)) << "no hand is there";
  EXPECT_EQ(locate(space).locationFlags, 15U);
  runtime_.hand_flags = 15;
  EXPECT_EQ(resync(session, right), XR_SUCCESS);
  EXPECT_TRUE(is_active(session, right));
  EXPECT_FALSE(is_active(session, eyes())) << "a hand in use says nothing about the eyes";
}

TEST_F(GazeLayerChain, RefusesEyesOfAnActionThatIsNotTheirs) {
  ASSERT_EQ(create({kGaze}), XR_SUCCESS);
  const XrSession session = make_session();
  make_action();
  const XrActionSpaceCreateInfo info{XR_TYPE_ACTION_SPACE_CREATE_INFO, nullptr, action_, eyes(), xr::kIdentityPose};
  XrSpace space = XR_NULL_HANDLE;
  EXPECT_EQ(create_action_space(session, &info, &space), XR_ERROR_PATH_UNSUPPORTED);
}

TEST_F(GazeLayerChain, PutsTheGazeUponTheHead) {
  ASSERT_EQ(create({kGaze}), XR_SUCCESS);
  const XrSession session = focused_session();
  const XrSpace space = make_space(session);
  // The head looks to the left and stands elsewhere.
  runtime_.head = {{0.0F, 0.70710678F, 0.0F, 0.70710678F}, {1.0F, 2.0F, 3.0F}};
  XrEyeGazeSampleTimeEXT sample{XR_TYPE_EYE_GAZE_SAMPLE_TIME_EXT, nullptr, -1};
  XrSpaceVelocity velocity{XR_TYPE_SPACE_VELOCITY, &sample, 3, {}, {}};
  XrSpaceLocation location{XR_TYPE_SPACE_LOCATION, &velocity, 0, xr::kIdentityPose};
  ASSERT_EQ(locate_space(space, kBase, kNow, &location), XR_SUCCESS);
  const tracking::Pose pose = xr::pose_of(location.pose);
  EXPECT_LT(glm::length(pose.direction({0.0, 0.0, -1.0}) - xr::pose_of(runtime_.head).direction(kLook)), 1e-6);
  EXPECT_EQ(location.pose.position.y, 2.0F);
  EXPECT_EQ(sample.time, kNow);
  EXPECT_EQ(velocity.velocityFlags, 0U);
  // A head that is lost takes the gaze along; one whose place is guessed leaves it untracked.
  runtime_.head_flags = XR_SPACE_LOCATION_ORIENTATION_VALID_BIT;
  EXPECT_EQ(locate(space).locationFlags, 0U);
  runtime_.head_flags = 7;
  EXPECT_EQ(locate(space).locationFlags, 3U);
  EXPECT_EQ(locate_space(space, kBase, 0, &location), XR_ERROR_TIME_INVALID);
  location.type = XR_TYPE_UNKNOWN;
  EXPECT_EQ(locate_space(space, kBase, kNow, &location), XR_ERROR_VALIDATION_FAILURE);
  EXPECT_EQ(locate_space(space, kBase, kNow, nullptr), XR_ERROR_VALIDATION_FAILURE);
}

TEST_F(GazeLayerChain, GivesNothingWithoutTheFocus) {
  ASSERT_EQ(create({kGaze, kEyes}), XR_SUCCESS);
  const XrSession session = make_session();
  make_action();
  ASSERT_EQ(suggest(profile(), gaze_pose()), XR_SUCCESS);
  attach_and_sync(session);
  const XrSpace space = make_space(session);
  const XrEyeTrackerCreateInfoFB tracker_info{XR_TYPE_EYE_TRACKER_CREATE_INFO_FB, nullptr};
  XrEyeTrackerFB tracker = XR_NULL_HANDLE;
  ASSERT_EQ(create_eye_tracker(session, &tracker_info, &tracker), XR_SUCCESS);
  const auto gives = [&] {
    const XrEyeGazesInfoFB info{XR_TYPE_EYE_GAZES_INFO_FB, nullptr, kBase, kNow};
    XrEyeGazesFB gazes{};
    gazes.type = XR_TYPE_EYE_GAZES_FB;
    EXPECT_EQ(get_eye_gazes(tracker, &info, &gazes), XR_SUCCESS);
    const bool eyes_valid = gazes.gaze[0].isValid && gazes.gaze[1].isValid;
    const bool gaze_valid = locate(space).locationFlags != 0;
    EXPECT_EQ(eyes_valid, gaze_valid);
    EXPECT_EQ(eyes_valid, gazes.gaze[0].gazeConfidence == 1.0F);
    EXPECT_EQ(gaze_valid, is_active(session));
    return gaze_valid;
  };
  for (const XrSessionState state : {XR_SESSION_STATE_READY, XR_SESSION_STATE_SYNCHRONIZED, XR_SESSION_STATE_VISIBLE}) {
    enter(session, state);
    EXPECT_FALSE(gives()) << state;
  }
  enter(session, XR_SESSION_STATE_FOCUSED);
  EXPECT_TRUE(gives());
  enter(session, XR_SESSION_STATE_VISIBLE);
  EXPECT_FALSE(gives());
  // In the focus, but with the action's set not among those asked for.
  enter(session, XR_SESSION_STATE_FOCUSED);
  const XrActionsSyncInfo none{XR_TYPE_ACTIONS_SYNC_INFO, nullptr, 0, nullptr};
  EXPECT_EQ(sync_actions(session, &none), XR_SUCCESS);
  EXPECT_EQ(locate(space).locationFlags, 0U);
  EXPECT_FALSE(is_active(session));
  EXPECT_EQ(resync(session), XR_SUCCESS);
  EXPECT_TRUE(is_active(session));
  runtime_.focused = false;
  EXPECT_EQ(resync(session), XR_SESSION_NOT_FOCUSED);
  EXPECT_FALSE(is_active(session));
}

TEST_F(GazeLayerChain, LeavesARuntimeWithGazeOfItsOwnAlone) {
  runtime_.extensions.insert({kGaze, kEyes});
  runtime_.has_gaze = runtime_.has_eyes = true;
  ASSERT_EQ(create({kGaze, kEyes}), XR_SUCCESS);
  EXPECT_EQ(runtime_.enabled, (std::vector<std::string>{kGaze, kEyes, kTimespec}));
  const XrSession session = focused_session({eyes()});
  EXPECT_EQ(runtime_.suggested_profiles, std::vector{profile()});
  EXPECT_EQ(runtime_.subaction_paths, std::vector{eyes()});
  const XrSpace space = make_space(session, eyes());
  EXPECT_EQ(runtime_.space_subaction, eyes());
  runtime_.hand = {{0.0F, 0.0F, 0.0F, 1.0F}, {9.0F, 0.0F, 0.0F}};  // the runtime's own gaze
  runtime_.hand_flags = 15;
  EXPECT_EQ(locate(space).pose.position.x, 9.0F);
  const XrEyeTrackerCreateInfoFB info{XR_TYPE_EYE_TRACKER_CREATE_INFO_FB, nullptr};
  XrEyeTrackerFB tracker = XR_NULL_HANDLE;
  ASSERT_EQ(create_eye_tracker(session, &info, &tracker), XR_SUCCESS);
  const XrEyeGazesInfoFB gaze_info{XR_TYPE_EYE_GAZES_INFO_FB, nullptr, kBase, kNow};
  XrEyeGazesFB gazes{};
  gazes.type = XR_TYPE_EYE_GAZES_FB;
  ASSERT_EQ(get_eye_gazes(tracker, &gaze_info, &gazes), XR_SUCCESS);
  EXPECT_EQ(gazes.time, 77) << "the runtime's answer";
  EXPECT_EQ(destroy_eye_tracker(tracker), XR_SUCCESS);
  EXPECT_EQ(runtime_.reference_spaces, 0);
}

TEST_F(GazeLayerChain, TakesARuntimesGazeOverWhenTold) {
  setenv("VERGENCE_GAZE_FORCE", "1", 1);
  runtime_.extensions.insert({kGaze, kEyes});
  runtime_.has_gaze = runtime_.has_eyes = true;
  ASSERT_EQ(create({kGaze, kEyes}), XR_SUCCESS);
  const XrSession session = focused_session();
  const auto located = locate(make_space(session));
  EXPECT_LT(glm::length(xr::pose_of(located.pose).direction({0.0, 0.0, -1.0}) - kLook), 1e-6);
}

TEST_F(GazeLayerChain, LetsATrackedHandGoFirst) {
  ASSERT_EQ(create({kGaze}), XR_SUCCESS);
  const XrSession session = make_session();
  make_action();
  ASSERT_EQ(suggest(path("/interaction_profiles/khr/simple_controller"), path("/user/hand/right/input/aim/pose")),
            XR_SUCCESS);
  ASSERT_EQ(suggest(profile(), gaze_pose()), XR_SUCCESS);
  attach_and_sync(session);
  enter(session, XR_SESSION_STATE_FOCUSED);
  const XrSpace space = make_space(session);
  runtime_.hand = {{0.0F, 0.0F, 0.0F, 1.0F}, {5.0F, 0.0F, 0.0F}};
  runtime_.hand_flags = 15;
  EXPECT_EQ(locate(space).pose.position.x, 5.0F);
  EXPECT_TRUE(is_active(session));
  runtime_.hand_flags = 0;
  EXPECT_EQ(locate(space).pose.position.x, 0.0F);
  EXPECT_EQ(locate(space).locationFlags, 15U);
  EXPECT_TRUE(is_active(session));
}

TEST_F(GazeLayerChain, TellsOnceThatTheEyesHaveAProfile) {
  ASSERT_EQ(create({kGaze}), XR_SUCCESS);
  const XrSession session = focused_session();
  XrEventDataBuffer event{};
  ASSERT_EQ(poll_event(instance_, &event), XR_SUCCESS);
  EXPECT_EQ(event.type, XR_TYPE_EVENT_DATA_INTERACTION_PROFILE_CHANGED);
  EXPECT_EQ(reinterpret_cast<const XrEventDataInteractionProfileChanged&>(event).session, session);
  EXPECT_EQ(resync(session), XR_SUCCESS);
  EXPECT_EQ(poll_event(instance_, &event), XR_EVENT_UNAVAILABLE);
}

TEST_F(GazeLayerChain, ALaterSuggestionReplacesAnEarlier) {
  ASSERT_EQ(create({kGaze}), XR_SUCCESS);
  const XrSession session = make_session();
  make_action();
  ASSERT_EQ(suggest(profile(), gaze_pose()), XR_SUCCESS);
  const XrAction first = action_;
  const XrActionSet set = set_;
  XrActionCreateInfo info{};
  info.type = XR_TYPE_ACTION_CREATE_INFO;
  info.actionType = XR_ACTION_TYPE_POSE_INPUT;
  ASSERT_EQ(create_action(set, &info, &action_), XR_SUCCESS);
  ASSERT_EQ(suggest(profile(), gaze_pose()), XR_SUCCESS);
  attach_and_sync(session);
  enter(session, XR_SESSION_STATE_FOCUSED);
  EXPECT_TRUE(is_active(session));
  action_ = first;
  EXPECT_FALSE(is_active(session));
}

TEST_F(GazeLayerChain, ForgetsWhatIsDestroyed) {
  ASSERT_EQ(create({kGaze, kEyes}), XR_SUCCESS);
  const XrSession session = focused_session();
  const XrSpace space = make_space(session);
  EXPECT_NE(locate(space).locationFlags, 0U);
  const XrEyeTrackerCreateInfoFB info{XR_TYPE_EYE_TRACKER_CREATE_INFO_FB, nullptr};
  XrEyeTrackerFB tracker = XR_NULL_HANDLE, other = XR_NULL_HANDLE;
  ASSERT_EQ(create_eye_tracker(session, &info, &tracker), XR_SUCCESS);
  ASSERT_EQ(destroy_eye_tracker(tracker), XR_SUCCESS);
  EXPECT_EQ(destroy_eye_tracker(tracker), XR_ERROR_HANDLE_INVALID);
  ASSERT_EQ(create_eye_tracker(session, &info, &other), XR_SUCCESS);
  EXPECT_NE(other, tracker) << "a stale handle must not name a new tracker";
  EXPECT_EQ(create_eye_tracker(session, nullptr, &other), XR_ERROR_VALIDATION_FAILURE);
  // A space goes on when its action is destroyed, as the specification has it.
  ASSERT_EQ(destroy_action(action_), XR_SUCCESS);
  EXPECT_EQ(destroy_action(action_), XR_ERROR_HANDLE_INVALID);
  EXPECT_NE(locate(space).locationFlags, 0U);
  ASSERT_EQ(destroy_space(space), XR_SUCCESS);
  ASSERT_EQ(destroy_action_set(set_), XR_SUCCESS);
  const int spaces_before = runtime_.destroyed_spaces;
  ASSERT_EQ(destroy_session(session), XR_SUCCESS);
  EXPECT_EQ(runtime_.destroyed_spaces, spaces_before + runtime_.reference_spaces) << "the layer's own";
  EXPECT_EQ(destroy_session(session), XR_ERROR_HANDLE_INVALID);
  EXPECT_EQ(handles().eye_trackers.size(), 0U);
}

TEST_F(GazeLayerChain, PassesOnWhyThereIsNoInstance) {
  runtime_.create_result = XR_ERROR_RUNTIME_UNAVAILABLE;
  EXPECT_EQ(create({kGaze}), XR_ERROR_RUNTIME_UNAVAILABLE);
  XrInstanceCreateInfo info{};
  info.type = XR_TYPE_INSTANCE_CREATE_INFO;
  XrApiLayerCreateInfo wrong{};
  EXPECT_EQ(create_instance(&info, &wrong, &instance_), XR_ERROR_INITIALIZATION_FAILED);
  EXPECT_EQ(create_instance(nullptr, nullptr, &instance_), XR_ERROR_INITIALIZATION_FAILED);
  instance_ = XR_NULL_HANDLE;
}

TEST_F(GazeLayerChain, IsBlindWithSettingsItCannotUse) {
  struct Setting {
    const char *name, *value, *said;
  };
  for (const Setting& s :
       {Setting{"VERGENCE_GAZE_END", "again", "VERGENCE_GAZE_END: 'again' is not one of hold"},
        Setting{"VERGENCE_GAZE_FORCE", "yes", "VERGENCE_GAZE_FORCE: 'yes' is neither 0 nor 1"},
        Setting{"VERGENCE_GAZE_SOCKET", "/tmp/x", "VERGENCE_GAZE_SOCKET: VERGENCE_GAZE_TRACE is set too"}}) {
    setenv(s.name, s.value, 1);
    testing::internal::CaptureStderr();
    ASSERT_EQ(create({kGaze}), XR_SUCCESS);
    EXPECT_NE(testing::internal::GetCapturedStderr().find(s.said), std::string::npos) << s.name;
    const XrSession session = focused_session();
    EXPECT_FALSE(is_active(session));
    EXPECT_EQ(locate(make_space(session)).locationFlags, 0U);
    EXPECT_EQ(destroy_instance(instance_), XR_SUCCESS);
    unsetenv(s.name);
  }
  instance_ = XR_NULL_HANDLE;
}

TEST_F(GazeLayerChain, MayBeCalledFromManyThreads) {
  ASSERT_EQ(create({kGaze, kEyes}), XR_SUCCESS);
  const XrSession session = focused_session();
  const XrSpace space = make_space(session);
  std::vector<std::jthread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&] {
      for (int i = 0; i < 2000; ++i) {
        XrSpaceLocation location{XR_TYPE_SPACE_LOCATION, nullptr, 0, xr::kIdentityPose};
        ASSERT_EQ(locate_space(space, kBase, kNow + i, &location), XR_SUCCESS);
        ASSERT_EQ(location.locationFlags, 15U);
        const XrEyeTrackerCreateInfoFB info{XR_TYPE_EYE_TRACKER_CREATE_INFO_FB, nullptr};
        XrEyeTrackerFB tracker = XR_NULL_HANDLE;
        ASSERT_EQ(create_eye_tracker(session, &info, &tracker), XR_SUCCESS);
        const XrEyeGazesInfoFB gaze_info{XR_TYPE_EYE_GAZES_INFO_FB, nullptr, kBase, kNow};
        XrEyeGazesFB gazes{};
        gazes.type = XR_TYPE_EYE_GAZES_FB;
        ASSERT_EQ(get_eye_gazes(tracker, &gaze_info, &gazes), XR_SUCCESS);
        ASSERT_TRUE(gazes.gaze[0].isValid);
        ASSERT_EQ(destroy_eye_tracker(tracker), XR_SUCCESS);
      }
    });
  }
}

}  // namespace
