#include "render/live_frame.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "render/composite.hpp"
#include "render/frame_job.hpp"
#include "render/kernel_set.hpp"
#include "render/lens_forms/lens_form_cache.hpp"
#include "render/live_mask.hpp"
#include "render/live_picture.hpp"
#include "shaders/swap_red_blue.hpp"

namespace render {
namespace {

constexpr std::uint32_t kSwapGroup = 64, kGroupsAcross = 1024;
constexpr int kDividerPixels = 2;

// What is traced: the image and its guard band.
FrameConfig traced(const LiveConfig& config) {
  if (is_map(config.frame.mode) && !config.frame.range) {
    throw std::invalid_argument("a running map needs its range");
  }
  FrameConfig frame = config.frame;
  frame.width += 2 * config.guard_px;
  frame.height += 2 * config.guard_px;
  frame.keep_radiance = frame.keep_wavefront = false;
  frame.target_error.reset();
  return frame;
}

std::size_t pixels_of(const FrameConfig& frame) {
  return static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height);
}

std::vector<ViewSetup> guarded(std::vector<ViewSetup> views, const LiveConfig& config) {
  for (ViewSetup& view : views) {
    view.view.fov = with_guard(view.view.fov, config.frame.width, config.frame.height, config.guard_px);
  }
  return views;
}

void put_row(Image8& picture, int x, int y, const std::vector<std::uint32_t>& words, bool blue_first) {
  std::size_t to =
      3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x));
  for (const std::uint32_t word : words) {
    for (std::size_t c = 0; c < 3; ++c) {
      picture.rgb[to++] = static_cast<std::uint8_t>((word >> (8 * (blue_first ? 2 - c : c))) & 255U);
    }
  }
}

}  // namespace

tracking::FieldOfView with_guard(const tracking::FieldOfView& fov, int width, int height, int guard_px) {
  const double across = guard_px * (fov.tan_left + fov.tan_right) / width;
  const double up = guard_px * (fov.tan_down + fov.tan_up) / height;
  return {fov.tan_left + across, fov.tan_right + across, fov.tan_down + up, fov.tan_up + up};
}

namespace {

// The stages of layers under one name each.
std::vector<vk::StageTime> summed(const std::vector<vk::StageTime>& stages) {
  std::vector<vk::StageTime> sums;
  for (const vk::StageTime& stage : stages) {
    const auto found = std::ranges::find(sums, stage.name, &vk::StageTime::name);
    if (found == sums.end()) {
      sums.push_back(stage);
    } else {
      found->milliseconds += stage.milliseconds;
    }
  }
  return sums;
}

}  // namespace

struct LiveFrame::State {
  State(const RendererParts& parts, const lenses::LensModel& lenses, const std::vector<ViewSetup>& views,
        const LiveConfig& wanted)
      : device(parts.device),
        config(wanted),
        frame(traced(wanted)),
        compositor(parts.device),
        divider(parts.device, sizeof(std::uint32_t) * static_cast<std::size_t>(kDividerPixels * wanted.frame.height),
                vk::Memory::device),
        picture(parts.device),
        submission(parts.device) {
    if (config.hidden) {
      if (config.hidden->size() != config.eyes) {
        throw std::invalid_argument("what is hidden is told of each eye");
      }
      const MaskedField field{config.frame.width, config.frame.height, config.guard_px};
      mask.emplace(device, field, *config.hidden);
    }
    divider.write(std::vector<std::uint32_t>(static_cast<std::size_t>(kDividerPixels * wanted.frame.height), ~0U));
    make_pictures(parts, guarded(views, config));
    write_views(lenses, views);
    record_picture(parts, lenses, guarded(views, config));
  }

  void make_pictures(const RendererParts& parts, const std::vector<ViewSetup>& views) {
    if (!is_composed(frame)) {
      whole = std::make_unique<LivePicture>(parts, frame, views, mask.has_value());
      return;
    }
    plan = plan_moving_composite(frame, views);
    whole = std::make_unique<LivePicture>(parts, plan->whole.config, plan->whole.views, mask.has_value());
    if (plan->fovea) {
      fovea = std::make_unique<LivePicture>(parts, plan->fovea->config, plan->fovea->views, false);
    }
    const std::size_t data_bytes = sizeof(gpu::CompositeData) * static_cast<std::size_t>(gpu::kMostViews);
    composite_upload = std::make_unique<vk::Buffer>(device, data_bytes, vk::Memory::upload);
    composed = std::make_unique<vk::Buffer>(device, pixels_of(frame) * views.size() * 4, vk::Memory::device);
  }

  void write_views(const lenses::LensModel& lenses, const std::vector<ViewSetup>& views) {
    const lenses::LensModel& worn = forms.in_form(lenses, frame.accuracy.lens);
    const std::vector<ViewSetup> now = guarded(views, config);
    if (mask) {
      mask->update({whole->buffers, whole->config}, views);
    }
    if (!plan) {
      whole->write_views(worn, now);
      return;
    }
    aim_composite(*plan, frame, now);
    whole->write_views(worn, plan->whole.views);
    if (fovea) {
      fovea->write_views(worn, plan->fovea->views);
    }
    composite_upload->write(composite_data(*plan, frame, now));
  }

  void record_picture(const RendererParts& parts, const lenses::LensModel& lenses,
                      const std::vector<ViewSetup>& views) {
    const lenses::LensModel& worn = forms.in_form(lenses, frame.accuracy.lens);
    whole->record(picture, parts, worn, plan ? plan->whole.views : views, !plan);
    if (fovea) {
      picture.barrier();
      fovea->record(picture, parts, worn, plan->fovea->views, false);
    }
    if (plan) {
      const DrawnLayers layers{whole->buffers, fovea ? &fovea->buffers : nullptr};
      // No radiance is wanted: what is bound in its place may be anything that the kernel does not read.
      compositor.record(picture, frame, views.size(), *composite_upload, layers, *composed, *composed);
    }
  }

  // Every view's bytes for the display.
  [[nodiscard]] const vk::Buffer& shown() const { return plan ? *composed : whole->buffers.display; }
  [[nodiscard]] std::size_t shown_pixels() const { return pixels_of(frame) * config.pairs * config.eyes; }

  // Once the display's bytes are there: red and blue change places.
  void record_swap() {
    swap.emplace(device, shaders::swap_red_blue, std::vector{vk::Binding::storage_buffer}, sizeof(std::uint32_t),
                 std::span<const std::uint32_t>{}, "swap_red_blue");
    const auto pixels = static_cast<std::uint32_t>(shown_pixels());
    const std::uint32_t groups = (pixels + kSwapGroup - 1) / kSwapGroup;
    picture.barrier();
    picture.dispatch(*swap, {&shown()}, vk::bytes_of(pixels), std::min(groups, kGroupsAcross),
                     (groups + kGroupsAcross - 1) / kGroupsAcross);
  }

  // Columns [from, to) of an eye's image, as view `view` shows them.
  [[nodiscard]] vk::PixelBlock columns(std::size_t view, int from, int to) const {
    const std::size_t first = view * pixels_of(frame) +
                              static_cast<std::size_t>(config.guard_px) * static_cast<std::size_t>(frame.width) +
                              static_cast<std::size_t>(config.guard_px + from);
    return {.from = &shown(),
            .offset = 4 * first,
            .row_pixels = frame.width,
            .x = from,
            .width = to - from,
            .height = config.frame.height};
  }

  [[nodiscard]] std::vector<vk::PixelBlock> blocks_of(std::size_t eye) const {
    const int width = config.frame.width;
    if (config.pairs == 1) {
      return {columns(eye, 0, width)};
    }
    const int middle = width / 2;
    const int half = kDividerPixels / 2;
    return {columns(eye, 0, middle - half), columns(config.eyes + eye, middle + half, width),
            vk::PixelBlock{.from = &divider,
                           .row_pixels = kDividerPixels,
                           .x = middle - half,
                           .width = kDividerPixels,
                           .height = config.frame.height}};
  }

  [[nodiscard]] vk::ExternalImage image(std::size_t eye, std::uint32_t index) const {
    return {images[eye].at(index), config.frame.width, config.frame.height};
  }

  void record_copies() {
    for (std::size_t eye = 0; eye < images.size(); ++eye) {
      std::vector<vk::Commands>& list = copies.emplace_back();
      for (std::uint32_t i = 0; i < images[eye].size(); ++i) {
        vk::copy_to_image(list.emplace_back(device), blocks_of(eye), image(eye, i));
        list.back().timestamp("copy");
      }
    }
  }

  vk::Device& device;
  LiveConfig config;
  FrameConfig frame;
  LensFormCache forms;
  std::optional<CompositePlan> plan;  // of a frame with fewer traced pixels than shown ones
  Compositor compositor;
  std::optional<LiveMask> mask;
  std::unique_ptr<LivePicture> whole, fovea;
  std::unique_ptr<vk::Buffer> composite_upload, composed;
  vk::Buffer divider;
  std::optional<vk::Kernel> swap;
  vk::Commands picture;
  std::vector<std::vector<VkImage>> images;
  std::vector<std::vector<vk::Commands>> copies;  // by eye and image
  vk::Submission submission;                      // last: it waits for all of the above
};

LiveFrame::LiveFrame(Renderer& renderer, const lenses::LensModel& lenses, const std::vector<ViewSetup>& views,
                     const LiveConfig& config, const std::vector<std::vector<VkImage>>& images) {
  if (views.size() != config.pairs * config.eyes || images.size() != config.eyes ||
      views.size() > static_cast<std::size_t>(gpu::kMostViews)) {
    throw std::invalid_argument("a running picture needs a view for each eye of each pair, and images for each eye");
  }
  const FrameConfig frame = traced(config);
  state_ = std::make_unique<State>(renderer.parts(lenses, views, frame), lenses, views, config);
  state_->images = images;
  if (config.blue_first) {
    state_->record_swap();
  }
  state_->record_copies();
  vk::Commands* const picture = &state_->picture;
  state_->submission.start({&picture, 1});
  (void)state_->submission.wait();
}

LiveFrame::~LiveFrame() = default;

void LiveFrame::start(const lenses::LensModel& lenses, const std::vector<ViewSetup>& views,
                      std::span<const std::uint32_t> images) {
  State& s = *state_;
  (void)s.submission.wait();
  s.write_views(lenses, views);
  std::vector<vk::Commands*> work{&s.picture};
  for (std::size_t eye = 0; eye < images.size(); ++eye) {
    work.push_back(&s.copies.at(eye).at(images[eye]));
  }
  s.submission.start(work);
}

std::vector<vk::StageTime> LiveFrame::wait() {
  return summed(state_->submission.wait());
}

void LiveFrame::hide(std::vector<tracking::HiddenArea> hidden) {
  if (!state_->mask) {
    throw std::invalid_argument("this running picture was made to draw all of its images");
  }
  state_->mask->set(std::move(hidden));
}

double LiveFrame::hidden_fraction() const {
  return state_->mask ? state_->mask->hidden_fraction() : 0.0;
}

double LiveFrame::left_out_fraction() const {
  return state_->mask ? state_->mask->left_out_fraction() : 0.0;
}

ShownPictures LiveFrame::shown() const {
  ShownPictures shown{.eyes = {},
                      .width = state_->config.frame.width,
                      .height = state_->config.frame.height,
                      .blue_first = state_->config.blue_first};
  for (std::size_t eye = 0; eye < state_->config.eyes; ++eye) {
    shown.eyes.push_back(state_->blocks_of(eye));
  }
  return shown;
}

Image8 LiveFrame::read_picture(std::size_t eye) {
  State& s = *state_;
  (void)s.submission.wait();
  Image8 picture = black_image(s.config.frame.width, s.config.frame.height);
  for (const vk::PixelBlock& block : s.blocks_of(eye)) {
    for (int y = 0; y < block.height; ++y) {
      const std::size_t from =
          block.offset + 4 * static_cast<std::size_t>(y) * static_cast<std::size_t>(block.row_pixels);
      put_row(picture, block.x, y, block.from->read<std::uint32_t>(static_cast<std::size_t>(block.width), from),
              s.config.blue_first);
    }
  }
  return picture;
}

Image8 LiveFrame::read_image(std::size_t eye, std::uint32_t image) {
  State& s = *state_;
  (void)s.submission.wait();
  const vk::ExternalImage from = s.image(eye, image);
  const auto width = static_cast<std::size_t>(from.width);
  vk::Buffer pixels(s.device, 4 * width * static_cast<std::size_t>(from.height), vk::Memory::readback);
  vk::Commands commands(s.device);
  vk::copy_from_image(commands, from, pixels);
  (void)s.device.run(commands);
  Image8 picture = black_image(from.width, from.height);
  for (int y = 0; y < from.height; ++y) {
    put_row(picture, 0, y, pixels.read<std::uint32_t>(width, 4 * width * static_cast<std::size_t>(y)),
            s.config.blue_first);
  }
  return picture;
}

}  // namespace render
