// The controllers' buttons as controls, on a real Monado.
#include "xr/controls.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/support/monado.hpp"
#include "tests/support/remote_head.hpp"

namespace {

using xr::Control;

const std::array kProfiles{"/interaction_profiles/khr/simple_controller",
                           "/interaction_profiles/oculus/touch_controller",
                           "/interaction_profiles/valve/index_controller", "/interaction_profiles/htc/vive_controller"};

TEST(ControlBindings, GiveEachControlOneButtonAProfile) {
  for (const std::string profile : kProfiles) {
    std::set<std::string_view> paths;
    std::set<Control> controls;
    for (const xr::ControlBinding& binding : xr::control_bindings()) {
      if (binding.profile == profile) {
        EXPECT_TRUE(paths.insert(binding.path).second) << profile << binding.path;
        EXPECT_TRUE(controls.insert(binding.control).second) << profile << xr::name(binding.control);
      }
    }
    const bool simple = profile == kProfiles[0];
    EXPECT_EQ(controls.size(), simple ? 4U : xr::kControls.size()) << profile;
    EXPECT_TRUE(controls.contains(Control::clear_view)) << profile;
  }
}

// The client leaves out a profile that a runtime does not know; a path that is wrong would go with it unseen.
TEST(ControlBindings, AreTakenByTheRuntime) {
  const support::Monado monado;
  const xr::Instance instance({.application = "controls test", .wanted_extensions = {}});
  xr::ActionSet set(instance, "controls", "Controls");
  const XrAction action = set.add_action(XR_ACTION_TYPE_BOOLEAN_INPUT, "press", "Press");
  for (const char* profile : kProfiles) {
    std::vector<XrActionSuggestedBinding> suggested;
    for (const xr::ControlBinding& binding : xr::control_bindings()) {
      if (binding.profile == profile) {
        suggested.push_back({action, instance.path(std::string(binding.path).c_str())});
      }
    }
    const XrInteractionProfileSuggestedBinding info{XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING, nullptr,
                                                    instance.path(profile),
                                                    static_cast<std::uint32_t>(suggested.size()), suggested.data()};
    EXPECT_EQ(xrSuggestInteractionProfileBindings(instance.handle(), &info), XR_SUCCESS) << profile;
  }
}

// A button of Monado's Index controllers, and the control that it stands for.
struct Button {
  Control control;
  bool support::RemoteHand::*pressed;
  support::RemoteHand support::RemoteHands::*hand;
};

constexpr auto kLeft = &support::RemoteHands::left, kRight = &support::RemoteHands::right;
using support::RemoteHand;
const std::array kButtons{Button{Control::spectacles, &RemoteHand::a_click, kRight},
                          Button{Control::next_pair, &RemoteHand::b_click, kRight},
                          Button{Control::compare, &RemoteHand::a_click, kLeft},
                          Button{Control::map, &RemoteHand::b_click, kLeft},
                          Button{Control::next_target, &RemoteHand::trigger_click, kRight},
                          Button{Control::recentre, &RemoteHand::thumbstick_click, kLeft},
                          Button{Control::clear_view, &RemoteHand::trigger_click, kLeft}};

TEST(Controls, ArePressedOnce) {
  support::leave_network();
  const support::Monado monado({.remote = true});
  support::RemoteHub hub;
  const xr::Instance instance({.application = "controls test", .wanted_extensions = {XR_MND_HEADLESS_EXTENSION_NAME}});
  xr::ActionBindings bindings(instance);
  const xr::Controls controls(instance, bindings);
  xr::Session session(instance);
  bindings.attach(session);
  const auto told = [&](const support::RemoteHands& hands) {
    hub.tell(hands);
    bindings.sync(session);
    return controls.pressed(session);
  };
  EXPECT_TRUE(controls.pressed(session).empty()) << "before the focus";
  while (!session.is_focused()) {
    while (const auto event = instance.poll()) {
      session.handle(*event);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_TRUE(told({}).empty());
  support::RemoteHands all;
  for (const Button& button : kButtons) {
    support::RemoteHands hands;
    (hands.*button.hand).*button.pressed = true;
    (all.*button.hand).*button.pressed = true;
    EXPECT_EQ(told(hands), std::vector{button.control}) << xr::name(button.control);
    EXPECT_TRUE(told(hands).empty()) << "held";
    EXPECT_TRUE(told({}).empty()) << "let go";
    EXPECT_EQ(told(hands), std::vector{button.control}) << "again";
    EXPECT_TRUE(told({}).empty());
  }
  EXPECT_EQ(told(all), std::vector(xr::kControls.begin(), xr::kControls.end()));
}

}  // namespace
