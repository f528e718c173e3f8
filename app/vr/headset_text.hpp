// What a session in the headset tells the person inside: pair, gaze source, accuracy, warnings, and what the display
// cannot show, on a panel low in the field of view.
#pragma once

#include "app/notice/display_limits.hpp"
#include "app/notice/notice.hpp"
#include "app/vr/text_panel.hpp"
#include "app/vr/world.hpp"
#include "xr/frame_loop.hpp"

namespace app {

// image_width, display_width: pixels of one eye, of the picture drawn and of the display. A headset file knows the
// display better than the runtime, whose recommendation allows for distortion.
[[nodiscard]] DisplayLimits display_limits(const RenderSetup& setup, bool has_headset_file,
                                           const tracking::FieldOfView& fov, int image_width, int display_width);

// Of the picture placed last.
[[nodiscard]] NoticeContent notice_content(const VrWorld& world, const std::vector<PlateLine>& limits);

class HeadsetText {
 public:
  // Refers to device, session and loop.
  HeadsetText(const render::vk::Device& device, const xr::Session& session, const xr::FrameLoop& loop);

  // Once a frame, when its head and eyes are placed, on the thread that submits.
  void update(const VrWorld& world, const xr::Frame& frame);

  [[nodiscard]] const xr::Panel& panel() const { return text_.panel(); }

 private:
  void see_display(const VrWorld& world, const xr::Frame& frame);

  const xr::FrameLoop& loop_;
  int display_width_;  // px of one eye, as the runtime recommends
  Notice notice_;
  TextPanel text_;
  TextPanelConfig config_;
  std::vector<PlateLine> limits_;  // empty before the first frame
};

}  // namespace app
