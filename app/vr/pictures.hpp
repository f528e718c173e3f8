// The running pictures of a session in the headset: made for what is worn and for the images of one runtime's
// swapchains, and gone with them.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "app/render_setup.hpp"
#include "render/live_frame.hpp"
#include "xr/frame_loop.hpp"
#include "xr/visibility_mask.hpp"

namespace app {

class Pictures {
 public:
  // Refers to renderer, loop and masks. config: see VrWorld.
  Pictures(render::Renderer& renderer, const xr::FrameLoop& loop, xr::VisibilityMasks& masks,
           const render::LiveConfig& config);

  // Makes the picture now, if there is none yet.
  void prepare(const RenderSetup& setup);

  // Submits a picture into the swapchains' images, by Side. It must have been prepared.
  void start(const RenderSetup& setup, const std::array<std::uint32_t, 2>& images);
  // Until the last picture is done; its stages. Empty where none was started.
  std::vector<render::vk::StageTime> wait();

  // What was shown last: left eye | right eye. Nothing where there was no picture.
  [[nodiscard]] std::optional<render::Image8> read_picture();

  [[nodiscard]] int guard_px() const { return config_.guard_px; }
  // As the runtime's masks have it now: what is hidden of the images, what is not drawn of the traced pixels, 0 to 1.
  [[nodiscard]] double hidden_fraction() const { return live_ ? live_->hidden_fraction() : 0.0; }
  [[nodiscard]] double left_out_fraction() const { return live_ ? live_->left_out_fraction() : 0.0; }
  // Why a mask was not taken; empty: none was refused.
  [[nodiscard]] const std::string& mask_problem() const { return mask_problem_; }

 private:
  // Of each eye in the order of the views.
  [[nodiscard]] std::vector<tracking::HiddenArea> hidden_areas(const RenderSetup& setup);

  render::Renderer& renderer_;
  const xr::FrameLoop& loop_;
  xr::VisibilityMasks& masks_;
  render::LiveConfig config_;
  std::string mask_problem_;
  std::unique_ptr<render::LiveFrame> live_;
};

}  // namespace app
