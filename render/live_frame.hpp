// A picture made again and again for moving heads and eyes, straight into images of somebody else's (a headset's
// swapchain). What to do is recorded once; a frame only writes where head and eyes are and submits: no compiling, no
// allocation, no way round by the host.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "render/mirror_copy.hpp"
#include "render/renderer.hpp"
#include "render/vk/external.hpp"

namespace render {

struct LiveConfig {
  // Of each eye's image; a map needs its range, dof takes all its samples in every frame.
  FrameConfig frame;
  // Pixels drawn beyond each side of the image and not shown, so that blur at its border gathers what lies outside.
  int guard_px = 0;
  std::size_t eyes = 2;
  bool blue_first = false;  // the byte order of the images
  std::size_t pairs = 1;    // 2: pair A left, pair B right of a divider in each eye's image
};

class LiveFrame {
 public:
  // images: those that each eye is drawn into, of the frame's size. views: pair by pair, in each eye by eye; lenses and
  // their order stay, everything else of a view may change from frame to frame. Draws one frame that nobody sees, so
  // that drivers compile now. Throws vk::DeviceError, also for a size that the device's buffers cannot hold;
  // std::invalid_argument for a map without a range.
  LiveFrame(Renderer& renderer, const lenses::LensModel& lenses, const std::vector<ViewSetup>& views,
            const LiveConfig& config, const std::vector<std::vector<VkImage>>& images);
  ~LiveFrame();
  LiveFrame(const LiveFrame&) = delete;
  LiveFrame& operator=(const LiveFrame&) = delete;

  // Waits for the frame before, then submits this one for image images[i] of eye i. `lenses` may have moved since the
  // constructor, no more.
  void start(const lenses::LensModel& lenses, const std::vector<ViewSetup>& views,
             std::span<const std::uint32_t> images);
  // Until the frame is done; the device's times of its stages.
  std::vector<vk::StageTime> wait();

  // Where what all eyes are shown lies while this lives: of the frame submitted last once it is done, until the next is
  // submitted.
  [[nodiscard]] ShownPictures shown() const;

  // What an eye was shown last.
  [[nodiscard]] Image8 read_picture(std::size_t eye);
  // Reads an image back as it was left, between start() and the next. It must allow copies from it.
  [[nodiscard]] Image8 read_image(std::size_t eye, std::uint32_t image);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// The same view with `guard_px` pixels more on every side of its width x height.
[[nodiscard]] tracking::FieldOfView with_guard(const tracking::FieldOfView& fov, int width, int height, int guard_px);

}  // namespace render
