// The running pictures of a session in the headset: made for what is worn and for the images of one runtime's
// swapchains, and gone with them.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "app/render_setup.hpp"
#include "render/live_frame.hpp"
#include "xr/frame_loop.hpp"

namespace app {

class Pictures {
 public:
  // Refers to renderer and loop. config: see VrWorld.
  Pictures(render::Renderer& renderer, const xr::FrameLoop& loop, const render::LiveConfig& config);

  // Makes the picture now, if there is none yet.
  void prepare(const RenderSetup& setup);

  // Submits a picture into the swapchains' images, by Side. It must have been prepared.
  void start(const RenderSetup& setup, const std::array<std::uint32_t, 2>& images);
  // Until the last picture is done; its stages. Empty where none was started.
  std::vector<render::vk::StageTime> wait();

  // What was shown last: left eye | right eye. Nothing where there was no picture.
  [[nodiscard]] std::optional<render::Image8> read_picture();

  [[nodiscard]] int guard_px() const { return config_.guard_px; }

 private:
  render::Renderer& renderer_;
  const xr::FrameLoop& loop_;
  render::LiveConfig config_;
  std::unique_ptr<render::LiveFrame> live_;
};

}  // namespace app
