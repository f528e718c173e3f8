// The running pictures of a session in the headset: made for what is worn and shown, for a rung of accuracy and for the
// images of one runtime's swapchains, and gone with them.
#pragma once

#include <array>
#include <cstdint>
#include <list>
#include <memory>
#include <optional>
#include <vector>

#include "app/render_setup.hpp"
#include "app/vr/options.hpp"
#include "app/vr/shown.hpp"
#include "render/governor.hpp"
#include "render/live_frame.hpp"
#include "xr/frame_loop.hpp"

namespace app {

struct PictureKey {
  ShownPicture shown;
  std::size_t rung = 0;
  bool operator==(const PictureKey&) const = default;
};

class Pictures {
 public:
  // Refers to all of them but the rungs.
  Pictures(render::Renderer& renderer, const xr::FrameLoop& loop, const VrOptions& options,
           std::vector<render::GovernorRung> rungs);

  // Compiles what the picture needs, so that make() and start() compile nothing. setup: with the pairs that it shows,
  // here and below.
  void prepare(const PictureKey& key, const RenderSetup& setup);

  [[nodiscard]] bool has(const PictureKey& key) const;
  // Takes memory on the device and draws once unseen. Of 2 x 2000 x 2000 pixels a picture holds about 0.7 GiB, of half
  // the resolution a third of that; at most kMost are kept beside those of the first picture's rungs, and the one
  // that was not shown for the longest makes room. The setup's eyes are as at the start of a session, so that a picture
  // made late draws what one made early would.
  void make(const PictureKey& key, const RenderSetup& setup);

  // Submits a picture into the swapchains' images, by Side. It must have been made, and the one before waited for.
  void start(const PictureKey& key, const RenderSetup& setup, const std::array<std::uint32_t, 2>& images);

  // The picture under way, once it is done.
  struct Done {
    PictureKey key;
    std::vector<render::vk::StageTime> stages;
  };
  std::optional<Done> wait();

  // What was shown last: left eye | right eye. Nothing where there was no picture.
  [[nodiscard]] std::optional<render::Image8> read_picture();

  // Where it lies while it is under way and after, until the next is started. Something must have been shown.
  [[nodiscard]] render::ShownPictures shown() const { return made_.front().frame->shown(); }

  [[nodiscard]] std::optional<int> guard_px(const PictureKey& key) const;

 private:
  static constexpr std::size_t kMost = 4;

  struct Made {
    PictureKey key;
    render::LiveConfig config;
    std::unique_ptr<render::LiveFrame> frame;
  };

  [[nodiscard]] render::LiveConfig config_of(const PictureKey& key, const RenderSetup& setup) const;

  render::Renderer& renderer_;
  const xr::FrameLoop& loop_;
  const VrOptions& options_;
  std::vector<render::GovernorRung> rungs_;
  std::list<Made> made_;  // the last shown first
  bool shown_ = false;    // the first of them, if anything was
  bool under_way_ = false;
};

}  // namespace app
