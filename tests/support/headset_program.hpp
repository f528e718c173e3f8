// A program with a headset: instance, device, session and frame loop as `vergence vr` makes them.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/headset_device.hpp"
#include "xr/frame_loop.hpp"

namespace support {

struct HeadsetProgram {
  explicit HeadsetProgram(const xr::FrameLoopConfig& config = {}, bool validation = false,
                          std::vector<std::string> extensions = {XR_EXT_LOCAL_FLOOR_EXTENSION_NAME})
      : instance({.application = "headset test", .wanted_extensions = std::move(extensions)}),
        device(app::open_headset_device(instance, {.validation = validation})),
        session(instance, app::graphics_of(device)),
        loop(session, config) {}

  // The next frame that somebody would see; those before it go without a picture. Nothing: the session is over.
  [[nodiscard]] std::optional<xr::Frame> next_visible() {
    while (auto frame = loop.next()) {
      if (frame->should_render) {
        return frame;
      }
      loop.skip(*frame);
    }
    return std::nullopt;
  }

  // Through all states to the end.
  void leave() {
    session.request_exit();
    while (const auto frame = loop.next()) {
      loop.skip(*frame);
    }
  }

  xr::Instance instance;
  render::vk::Device device;
  xr::Session session;
  xr::FrameLoop loop;
};

}  // namespace support
