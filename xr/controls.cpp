#include "xr/controls.hpp"

#include <string>

namespace xr {
namespace {

struct Titled {
  Control control;
  std::string_view name, title;
};

constexpr std::array kTitles{
    Titled{Control::spectacles, "spectacles", "Spectacles on and off"},
    Titled{Control::next_pair, "next_pair", "Next pair"},
    Titled{Control::compare, "compare", "A against B"},
    Titled{Control::map, "map", "Map over the picture"},
    Titled{Control::next_target, "next_target", "Next target"},
    Titled{Control::recentre, "recentre", "Recentre"},
    Titled{Control::clear_view, "clear_view", "Clear view"},
};

constexpr const Titled& titled(Control control) {
  return kTitles[static_cast<std::size_t>(control)];
}

constexpr std::string_view kSimple = "/interaction_profiles/khr/simple_controller";
constexpr std::string_view kTouch = "/interaction_profiles/oculus/touch_controller";
constexpr std::string_view kIndex = "/interaction_profiles/valve/index_controller";
constexpr std::string_view kVive = "/interaction_profiles/htc/vive_controller";

constexpr std::array kBindings{
    ControlBinding{kSimple, Control::spectacles, "/user/hand/right/input/select/click"},
    ControlBinding{kSimple, Control::next_pair, "/user/hand/left/input/select/click"},
    ControlBinding{kSimple, Control::clear_view, "/user/hand/right/input/menu/click"},
    ControlBinding{kSimple, Control::next_target, "/user/hand/left/input/menu/click"},

    ControlBinding{kTouch, Control::spectacles, "/user/hand/right/input/a/click"},
    ControlBinding{kTouch, Control::next_pair, "/user/hand/right/input/b/click"},
    ControlBinding{kTouch, Control::compare, "/user/hand/left/input/x/click"},
    ControlBinding{kTouch, Control::map, "/user/hand/left/input/y/click"},
    ControlBinding{kTouch, Control::next_target, "/user/hand/right/input/trigger/value"},
    ControlBinding{kTouch, Control::recentre, "/user/hand/left/input/thumbstick/click"},
    ControlBinding{kTouch, Control::clear_view, "/user/hand/left/input/trigger/value"},

    ControlBinding{kIndex, Control::spectacles, "/user/hand/right/input/a/click"},
    ControlBinding{kIndex, Control::next_pair, "/user/hand/right/input/b/click"},
    ControlBinding{kIndex, Control::compare, "/user/hand/left/input/a/click"},
    ControlBinding{kIndex, Control::map, "/user/hand/left/input/b/click"},
    ControlBinding{kIndex, Control::next_target, "/user/hand/right/input/trigger/click"},
    ControlBinding{kIndex, Control::recentre, "/user/hand/left/input/thumbstick/click"},
    ControlBinding{kIndex, Control::clear_view, "/user/hand/left/input/trigger/click"},

    ControlBinding{kVive, Control::spectacles, "/user/hand/right/input/trackpad/click"},
    ControlBinding{kVive, Control::next_pair, "/user/hand/right/input/menu/click"},
    ControlBinding{kVive, Control::compare, "/user/hand/left/input/trackpad/click"},
    ControlBinding{kVive, Control::map, "/user/hand/left/input/menu/click"},
    ControlBinding{kVive, Control::next_target, "/user/hand/right/input/trigger/click"},
    ControlBinding{kVive, Control::recentre, "/user/hand/left/input/squeeze/click"},
    ControlBinding{kVive, Control::clear_view, "/user/hand/left/input/trigger/click"},
};

}  // namespace

std::string_view name(Control control) {
  return titled(control).name;
}

std::vector<ControlBinding> control_bindings() {
  return {kBindings.begin(), kBindings.end()};
}

Controls::Controls(const Instance& instance, ActionBindings& bindings) : set_(instance, "controls", "Controls") {
  for (std::size_t i = 0; i < kControls.size(); ++i) {
    const Titled& control = titled(kControls[i]);
    actions_[i] = set_.add_action(XR_ACTION_TYPE_BOOLEAN_INPUT, std::string(control.name), std::string(control.title));
  }
  bindings.add_set(set_);
  for (const ControlBinding& binding : kBindings) {
    bindings.suggest(std::string(binding.profile), actions_[static_cast<std::size_t>(binding.control)],
                     std::string(binding.path));
  }
}

std::vector<Control> Controls::pressed(const Session& session) const {
  std::vector<Control> pressed;
  for (std::size_t i = 0; i < kControls.size() && session.is_focused(); ++i) {
    XrActionStateGetInfo info{};
    info.type = XR_TYPE_ACTION_STATE_GET_INFO;
    info.action = actions_[i];
    XrActionStateBoolean state{};
    state.type = XR_TYPE_ACTION_STATE_BOOLEAN;
    check(xrGetActionStateBoolean(session.handle(), &info, &state), "xrGetActionStateBoolean");
    if (state.isActive != XR_FALSE && state.changedSinceLastSync != XR_FALSE && state.currentState != XR_FALSE) {
      pressed.push_back(kControls[i]);
    }
  }
  return pressed;
}

}  // namespace xr
