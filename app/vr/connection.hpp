// One runtime and what lives and dies with it: instance, device, renderer, session, input, frame loop, pictures.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "app/vr/headset_text.hpp"
#include "app/vr/mirror_feed.hpp"
#include "app/vr/pictures.hpp"
#include "app/vr/world.hpp"
#include "xr/actions.hpp"
#include "xr/controls.hpp"
#include "xr/frame_loop.hpp"
#include "xr/gaze_input.hpp"

namespace app {

using ControlSource = std::function<std::vector<xr::Control>()>;

class VrConnection {
 public:
  // Throws xr::Error and render::vk::DeviceError for what fails here. Refers to the world and to the mirror, if there
  // is one. more_controls: asked once a frame for what was pressed elsewhere than on the headset's controllers; may be
  // empty.
  explicit VrConnection(VrWorld& world, ControlSource more_controls = {}, MirrorLink* mirror = nullptr);

  // Until the session ends; xr::LostError where it is lost.
  void show_frames();

  // Once it has ended: the last picture's times and the screenshot, and what was compiled is kept.
  void finish();

 private:
  void describe();
  std::optional<xr::Frame> next_frame();
  void request_exit();
  bool stop_if_wanted();
  // time: s, the session's
  void show(const xr::Frame& frame, double time);
  void place(const xr::Frame& frame, double time);
  void heed_controls(const xr::Frame& frame);
  void recentre(const tracking::Pose& world_from_space, const tracking::Pose& new_from_old);
  void compile_pictures();
  void make_first_pictures(const xr::Frame& frame);
  void wait_for_device();

  VrWorld& world_;
  ControlSource more_controls_;
  xr::Instance instance_;
  render::vk::Device device_;
  render::Renderer renderer_;
  xr::Session session_;
  xr::ActionBindings bindings_;
  xr::GazeActions gaze_actions_;
  xr::Controls controls_;
  std::unique_ptr<xr::GazeInput> gaze_input_;  // once the bindings are attached
  xr::FrameLoop loop_;
  HiddenViews hidden_;
  tracking::Pose world_from_space_;
  std::optional<Pictures> pictures_;  // once the rungs are known
  std::optional<HeadsetText> text_;   // with --no-text there is none
  std::optional<MirrorFeed> mirror_;
  std::size_t kernels_prepared_ = 0;
  bool has_pictures_ = false;
  double processor_before_ = 0.0;  // ms of this thread, before the frame was waited for
  bool exit_requested_ = false;
};

}  // namespace app
