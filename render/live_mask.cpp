#include "render/live_mask.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <thread>
#include <utility>

#include "render/live_frame.hpp"
#include "render/shown_tiles.hpp"
#include "render/vk/commands.hpp"
#include "shaders/hide.hpp"

namespace render {
namespace {

using tracking::FieldOfView;
using tracking::PixelMask;

// How far beyond the blur itself a blurred pixel looks, px: it is judged by tiles of 8, and wide blurs gather squares
// of up to 8.
constexpr int kBeyondBlur = 16;
// A pixel's edges are told by its neighbours.
constexpr int kBeyondPixel = 1;
// A picture of fewer pixels is enlarged by a spline over two on either side.
constexpr int kBeyondTexel = 2;
constexpr double kSameField = 0.02;  // px that a field's border may move without a new list

bool is_same(const FieldOfView& a, const FieldOfView& b, int width) {
  const double pixels = width / (a.tan_left + a.tan_right);
  return pixels * std::max({std::abs(a.tan_left - b.tan_left), std::abs(a.tan_right - b.tan_right),
                            std::abs(a.tan_down - b.tan_down), std::abs(a.tan_up - b.tan_up)}) <=
         kSameField;
}

vk::Kernel hide_kernel(const vk::Device& device) {
  constexpr std::array kBindings{vk::Binding::texel_r32ui, vk::Binding::storage_buffer, vk::Binding::storage_buffer,
                                 vk::Binding::storage_buffer, vk::Binding::storage_buffer};
  return {device, shaders::hide, kBindings, sizeof(glm::ivec4), std::span<const std::uint32_t>{}, "hide"};
}

}  // namespace

LiveMask::LiveMask(vk::Device& device, const MaskedField& field, std::vector<tracking::HiddenArea> hidden)
    : device_(device), field_(field), kernel_(hide_kernel(device)), hidden_(std::move(hidden)) {}

void LiveMask::set(std::vector<tracking::HiddenArea> hidden) {
  if (hidden.size() != hidden_.size()) {
    throw std::invalid_argument("what is hidden is told of each eye");
  }
  hidden_ = std::move(hidden);
  listed_for_.clear();
}

bool LiveMask::is_current(std::span<const ViewSetup> views) const {
  for (std::size_t eye = 0; eye < listed_for_.size(); ++eye) {
    if (!is_same(listed_for_[eye], views[eye].view.fov, field_.width)) {
      return false;
    }
  }
  return !listed_for_.empty();
}

PixelMask LiveMask::left_out(std::size_t eye, const MaskedPicture& picture) const {
  const FrameConfig& config = picture.config;
  const FieldOfView& fov = listed_for_[eye];
  const double scale = config.width / double(field_.width + 2 * field_.guard_px);
  const int beyond = (config.mode == Mode::adof ? kBeyondBlur : kBeyondPixel) + (scale < 1.0 ? kBeyondTexel : 0);
  const int band = static_cast<int>(std::ceil(scale * field_.guard_px)) + beyond;
  const FieldOfView traced = with_guard(fov, field_.width, field_.height, field_.guard_px);
  return shrunk(hidden_pixels(with_outside(hidden_[eye], fov), traced, config.width, config.height), band);
}

void LiveMask::update(const MaskedPicture& picture, std::span<const ViewSetup> views) {
  if (is_current(views)) {
    return;
  }
  const int threads =
      device_.limits().on_processor ? static_cast<int>(std::max(1U, std::thread::hardware_concurrency())) : 1;
  const int width = picture.config.width, height = picture.config.height;
  const std::size_t eyes = hidden_.size();
  listed_for_.clear();
  std::vector<TileLists> lists;
  hidden_fraction_ = left_out_fraction_ = 0.0;
  for (std::size_t eye = 0; eye < eyes; ++eye) {
    listed_for_.push_back(views[eye].view.fov);
    lists.push_back(tile_lists(left_out(eye, picture), threads));
    const double all = static_cast<double>(lists.back().shown.size() + lists.back().hidden.size());
    left_out_fraction_ += static_cast<double>(lists.back().hidden.size()) / all / static_cast<double>(eyes);
    hidden_fraction_ += hidden_pixels(hidden_[eye], listed_for_[eye], field_.width, field_.height).hidden_fraction() /
                        static_cast<double>(eyes);
  }
  const std::size_t words = listed_tile_words(width, height);
  for (std::size_t view = 0; view < views.size(); ++view) {
    const TileLists& list = lists[view % eyes];
    picture.buffers.shown_tiles.write(padded(list.shown, width, height), view * words * sizeof(std::uint32_t));
    const auto counts = tile_counts(list.shown.size());
    picture.buffers.shown_counts.write(std::as_bytes(std::span(counts)), view * kShownCountsBytes);
    hide(picture, view, list.hidden);
  }
}

void LiveMask::hide(const MaskedPicture& picture, std::size_t view, const std::vector<std::uint32_t>& tiles) {
  if (tiles.empty()) {
    return;
  }
  const int width = picture.config.width, height = picture.config.height;
  vk::Buffer list(device_, listed_tile_words(width, height) * sizeof(std::uint32_t), vk::Memory::upload);
  list.write(padded(tiles, width, height));
  const auto groups = tile_counts(tiles.size());
  const glm::ivec4 which(width, height, static_cast<int>(view), 0);
  FrameBuffers& out = picture.buffers;
  vk::Commands commands(device_);
  commands.dispatch(kernel_, {&list, &out.pixels, &out.keys, &out.radiance, &out.display}, vk::bytes_of(which),
                    groups[0], groups[1]);
  (void)device_.run(commands);
}

}  // namespace render
