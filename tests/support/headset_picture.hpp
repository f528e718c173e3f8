// A scene in the headset of a test's own program: both eyes bare, looking straight ahead from the origin.
#pragma once

#include <array>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <utility>
#include <vector>

#include "render/live_frame.hpp"
#include "tests/support/headset_program.hpp"

namespace support {

struct HeadsetPicture {
  // right_eye: how that one is turned against the left.
  HeadsetPicture(HeadsetProgram& program, render::Scene shown, const glm::dquat& right_eye = {1.0, 0.0, 0.0, 0.0})
      : scene(std::move(shown)), renderer(program.device, scene, {.traversal = render::Traversal::per_ray}) {
    for (const tracking::Side side : {tracking::Side::left, tracking::Side::right}) {
      render::ViewSetup& view = views.emplace_back();
      view.lens = lenses::append_lens(model, nullptr, side, 0.00305);
      view.eye = lenses::make_eye_data(lenses::Eye{}, 5.0, 0.003);
      view.viewing = render::Viewing::fixed;
      view.view.fov = tracking::FieldOfView::symmetric(1.0, 1.0);
    }
    views[1].world_from_eye.orientation = right_eye;
    const xr::Swapchain& left = program.loop.swapchain(tracking::Side::left);
    render::LiveConfig config;
    config.frame.width = left.width();
    config.frame.height = left.height();
    config.frame.mode = render::Mode::pinhole;
    config.blue_first = left.format() == VK_FORMAT_B8G8R8A8_SRGB;
    live = std::make_unique<render::LiveFrame>(
        renderer, model, views, config,
        std::vector{left.images(), program.loop.swapchain(tracking::Side::right).images()});
  }

  // Into the program's next images: their indices, left and right.
  std::array<std::uint32_t, 2> start(HeadsetProgram& program) {
    const auto by_side = program.loop.acquire();
    const std::array images{by_side[1], by_side[0]};
    live->start(model, views, images);
    return images;
  }

  render::Scene scene;
  render::Renderer renderer;
  lenses::LensModel model;
  std::vector<render::ViewSetup> views;
  std::unique_ptr<render::LiveFrame> live;
};

}  // namespace support
