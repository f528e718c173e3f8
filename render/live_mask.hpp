// What a headset hides of running pictures: which tiles are drawn, told anew when the headset says so.
#pragma once

#include <span>
#include <vector>

#include "render/frame_buffers.hpp"
#include "render/view_setup.hpp"
#include "render/vk/kernel.hpp"
#include "tracking/hidden_area.hpp"

namespace render {

// A picture whose tiles are to be listed: the whole traced field, at the picture's resolution.
struct MaskedPicture {
  FrameBuffers& buffers;  // with room for the lists
  const FrameConfig& config;
};

// Of the eyes' images, their guard band and the field that is traced.
struct MaskedField {
  int width = 0, height = 0;  // of an image, px
  int guard_px = 0;           // traced beyond each side of it, and kept around what is seen within
};

class LiveMask {
 public:
  // hidden: of each eye, in its own view's axes.
  LiveMask(vk::Device& device, const MaskedField& field, std::vector<tracking::HiddenArea> hidden);

  void set(std::vector<tracking::HiddenArea> hidden);

  // Lists the tiles of all views of a picture anew where areas or fields of view have changed since. views: those of
  // the images, without a guard band, pair by pair, in each eye by eye. No work on the picture may be under way.
  void update(const MaskedPicture& picture, std::span<const ViewSetup> views);

  // Of the images' pixels, those that are hidden; of the traced picture's, those that are not drawn: 0 to 1.
  [[nodiscard]] double hidden_fraction() const { return hidden_fraction_; }
  [[nodiscard]] double left_out_fraction() const { return left_out_fraction_; }

 private:
  [[nodiscard]] bool is_current(std::span<const ViewSetup> views) const;
  [[nodiscard]] tracking::PixelMask left_out(std::size_t eye, const MaskedPicture& picture) const;
  void hide(const MaskedPicture& picture, std::size_t view, const std::vector<std::uint32_t>& tiles);

  vk::Device& device_;
  MaskedField field_;
  vk::Kernel kernel_;
  std::vector<tracking::HiddenArea> hidden_;
  std::vector<tracking::FieldOfView> listed_for_;  // of each eye; none: nothing is listed yet
  double hidden_fraction_ = 0.0, left_out_fraction_ = 0.0;
};

}  // namespace render
