// What the wearer's hands ask for: buttons of the controllers, as events that happen once.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "xr/actions.hpp"

namespace xr {

enum class Control {
  spectacles,   // on and off
  next_pair,    // the next pair of spectacles
  compare,      // A against B
  map,          // the next map over the picture, then none
  next_target,  // the next thing to look at
  recentre,     // the scene to where the head is
  clear_view    // no lens, no blur, no map: at once
};

inline constexpr std::array kControls{Control::spectacles,  Control::next_pair, Control::compare,   Control::map,
                                      Control::next_target, Control::recentre,  Control::clear_view};

// Lower case, as in OpenXR's paths and in recordings: "next_pair".
[[nodiscard]] std::string_view name(Control control);

// A button of a controller that stands for a control.
struct ControlBinding {
  std::string_view profile;  // "/interaction_profiles/oculus/touch_controller"
  Control control;
  std::string_view path;  // "/user/hand/right/input/a/click"
};

// Of the simple controller, which has four buttons and leaves out comparing, maps and recentring, and of the Touch,
// Index and Vive controllers, which have them all. What ends everything at once lies under a thumb or a forefinger.
[[nodiscard]] std::vector<ControlBinding> control_bindings();

class Controls {
 public:
  // Adds its set and its bindings; must outlive the session.
  Controls(const Instance& instance, ActionBindings& bindings);

  // What was pressed between the last two syncs, in the order of kControls. Nothing without the focus.
  [[nodiscard]] std::vector<Control> pressed(const Session& session) const;

 private:
  ActionSet set_;
  std::array<XrAction, kControls.size()> actions_{};
};

}  // namespace xr
