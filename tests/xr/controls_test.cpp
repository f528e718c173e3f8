// The controllers' buttons as controls, on a real Monado.
#include "xr/controls.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/support/monado.hpp"

namespace {

using xr::Control;

const std::array kProfiles{"/interaction_profiles/khr/simple_controller", "/interaction_profiles/oculus/touch_controller",
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
                                                    instance.path(profile), static_cast<std::uint32_t>(suggested.size()),
                                                    suggested.data()};
    EXPECT_EQ(xrSuggestInteractionProfileBindings(instance.handle(), &info), XR_SUCCESS) << profile;
  }
}

}  // namespace
