// The frame loop: waits for the runtime, says for what moment the next picture is and where head and eyes will then be,
// and hands the finished pictures over.
#pragma once

#include <array>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <span>

#include "tracking/stereo_view.hpp"
#include "xr/panel.hpp"
#include "xr/spaces.hpp"
#include "xr/swapchain.hpp"

namespace xr {

// One eye of the headset at the moment of display: its own pose (canted displays turn it) and its own field of view.
struct HeadsetView {
  tracking::Pose space_from_view;
  tracking::Pose head_from_view;
  tracking::FieldOfView fov;
};

struct Frame {
  XrTime display_time = 0;                      // predicted, of the middle of the display's exposure
  XrDuration period = 0;                        // ns from one frame to the next
  std::chrono::steady_clock::time_point woken;  // when xrWaitFrame returned
  bool should_render = false;                   // false: nobody would see it, or head or eyes are not known
  // In the loop's space, which is that of the scene. Last known where should_render is false for want of tracking.
  tracking::Pose space_from_head;
  std::array<HeadsetView, 2> views;  // indexed by tracking::Side
  // The space's origin moved before this frame: carries poses that were remembered from earlier frames into it.
  std::optional<tracking::Pose> new_from_old;
};

struct FrameLoopConfig {
  SpaceChoice space = SpaceChoice::automatic;
  std::optional<std::array<int, 2>> size;  // of each eye's image; absent: as the runtime recommends
  bool readable = false;                   // images can be copied from
};

class FrameLoop {
 public:
  // Refers to the session.
  FrameLoop(Session& session, const FrameLoopConfig& config);

  // Sees every event, before the frame that follows it.
  void on_event(std::function<void(const XrEventDataBuffer&)> listener) { listeners_.push_back(std::move(listener)); }
  // Called again and again while the session does not run (the headset is off); returning false ends the loop.
  void while_idle(std::function<bool()> idle) { idle_ = std::move(idle); }

  // The next frame, once it is time to make it; absent when the session is over. Each frame is ended by one of the two
  // calls below.
  [[nodiscard]] std::optional<Frame> next();
  // The images, by Side, that the frame is to be drawn into.
  [[nodiscard]] std::array<std::uint32_t, 2> acquire();
  // All work on the acquired images has been submitted. Panels lie over the picture, the last on top; one that is empty
  // is left out.
  void show(const Frame& frame, std::span<const Panel* const> panels = {});
  // Without a picture.
  void skip(const Frame& frame);

  [[nodiscard]] const Swapchain& swapchain(tracking::Side side) const {
    return *swapchains_[static_cast<std::size_t>(side)];
  }
  [[nodiscard]] const Space& space() const { return space_; }
  [[nodiscard]] const Space& view_space() const { return view_space_; }

 private:
  void poll();
  void locate(Frame& frame);
  void end(const Frame& frame, std::span<const XrCompositionLayerBaseHeader* const> layers);

  Session& session_;
  Space space_, view_space_;
  Recentring recentring_;
  std::array<std::unique_ptr<Swapchain>, 2> swapchains_;  // indexed by Side
  XrEnvironmentBlendMode blend_mode_ = XR_ENVIRONMENT_BLEND_MODE_OPAQUE;
  std::array<XrView, 2> located_{};  // in OpenXR's order: left, right
  Frame last_;
  std::vector<std::function<void(const XrEventDataBuffer&)>> listeners_;
  std::function<bool()> idle_;
};

// The sizes the runtime recommends, by Side.
[[nodiscard]] std::array<std::array<int, 2>, 2> recommended_sizes(const Instance& instance);

}  // namespace xr
