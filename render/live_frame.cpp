#include "render/live_frame.hpp"

#include <algorithm>
#include <stdexcept>

#include "render/frame_buffers.hpp"
#include "render/frame_job.hpp"
#include "render/kernel_set.hpp"
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

}  // namespace

tracking::FieldOfView with_guard(const tracking::FieldOfView& fov, int width, int height, int guard_px) {
  const double across = guard_px * (fov.tan_left + fov.tan_right) / width;
  const double up = guard_px * (fov.tan_down + fov.tan_up) / height;
  return {fov.tan_left + across, fov.tan_right + across, fov.tan_down + up, fov.tan_up + up};
}

struct LiveFrame::State {
  State(const RendererParts& parts, const lenses::LensModel& lenses, const std::vector<ViewSetup>& views,
        const LiveConfig& wanted, std::size_t view_count)
      : device(parts.device),
        config(wanted),
        frame(traced(wanted)),
        buffers(parts.device, {.pixels = pixels_of(frame) * view_count,
                               .wavefront = keeps_wavefront(frame, views),
                               .sums = frame.mode == Mode::dof,
                               .hits = parts.traversal != Traversal::per_ray}),
        upload(parts.device, sizeof(gpu::ViewData) * static_cast<std::size_t>(gpu::kMostViews), vk::Memory::upload),
        divider(parts.device, sizeof(std::uint32_t) * static_cast<std::size_t>(kDividerPixels * wanted.frame.height),
                vk::Memory::device),
        picture(parts.device),
        submission(parts.device) {
    divider.write(std::vector<std::uint32_t>(static_cast<std::size_t>(kDividerPixels * wanted.frame.height), ~0U));
    write_views(lenses, views);
    record_picture(parts, lenses, views);
  }

  void write_views(const lenses::LensModel& lenses, const std::vector<ViewSetup>& views) {
    upload.write(view_data(lenses, guarded(views, config)));
  }

  void record_picture(const RendererParts& parts, const lenses::LensModel& lenses,
                      const std::vector<ViewSetup>& views) {
    FrameJob job(device, parts.scene, parts.kernels, buffers, lenses, views, frame, parts.traversal);
    job.set_range(frame.range.value_or(MapRange{}));
    job.record_views(picture, upload);
    job.record_picture(picture);
    if (frame.mode == Mode::dof) {
      for (int i = 0; i < frame.samples; ++i) {
        job.record_sample(picture, i);
      }
      picture.timestamp("samples");
      job.record_encode(picture);
    }
  }

  // Once the display's bytes are there: red and blue change places.
  void record_swap() {
    swap.emplace(device, shaders::swap_red_blue, std::vector{vk::Binding::storage_buffer}, sizeof(std::uint32_t),
                 std::span<const std::uint32_t>{}, "swap_red_blue");
    const auto pixels = static_cast<std::uint32_t>(buffers.size.pixels);
    const std::uint32_t groups = (pixels + kSwapGroup - 1) / kSwapGroup;
    picture.barrier();
    picture.dispatch(*swap, {&buffers.display}, vk::bytes_of(pixels), std::min(groups, kGroupsAcross),
                     (groups + kGroupsAcross - 1) / kGroupsAcross);
  }

  // Columns [from, to) of an eye's image, as view `view` shows them.
  [[nodiscard]] vk::PixelBlock columns(std::size_t view, int from, int to) const {
    const std::size_t first = view * pixels_of(frame) +
                              static_cast<std::size_t>(config.guard_px) * static_cast<std::size_t>(frame.width) +
                              static_cast<std::size_t>(config.guard_px + from);
    return {.from = &buffers.display,
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
    return {targets[eye].images.at(index), config.frame.width, config.frame.height};
  }

  void record_copies() {
    for (std::size_t eye = 0; eye < targets.size(); ++eye) {
      std::vector<vk::Commands>& list = copies.emplace_back();
      for (std::uint32_t i = 0; i < targets[eye].images.size(); ++i) {
        vk::copy_to_image(list.emplace_back(device), blocks_of(eye), image(eye, i));
        list.back().timestamp("copy");
      }
    }
  }

  vk::Device& device;
  LiveConfig config;
  FrameConfig frame;
  FrameBuffers buffers;
  vk::Buffer upload, divider;
  std::optional<vk::Kernel> swap;
  vk::Commands picture;
  std::vector<LiveTarget> targets;
  std::vector<std::vector<vk::Commands>> copies;  // by eye and image
  vk::Submission submission;                      // last: it waits for all of the above
};

LiveFrame::LiveFrame(Renderer& renderer, const lenses::LensModel& lenses, const std::vector<ViewSetup>& views,
                     const LiveConfig& config, const std::vector<LiveTarget>& targets) {
  if (views.size() != config.pairs * config.eyes || targets.size() != config.eyes ||
      views.size() > static_cast<std::size_t>(gpu::kMostViews)) {
    throw std::invalid_argument("a running picture needs a view for each eye of each pair, and images for each eye");
  }
  const FrameConfig frame = traced(config);
  state_ = std::make_unique<State>(renderer.parts(lenses, views, frame), lenses, views, config, views.size());
  state_->targets = targets;
  if (std::ranges::any_of(targets, &LiveTarget::blue_first)) {
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
  for (std::size_t eye = 0; eye < s.copies.size(); ++eye) {
    work.push_back(&s.copies[eye].at(images[eye]));
  }
  s.submission.start(work);
}

std::vector<vk::StageTime> LiveFrame::wait() {
  return state_->submission.wait();
}

Image8 LiveFrame::read_image(std::size_t eye, std::uint32_t image) {
  State& s = *state_;
  (void)s.submission.wait();
  const vk::ExternalImage from = s.image(eye, image);
  const std::size_t count = static_cast<std::size_t>(from.width) * static_cast<std::size_t>(from.height);
  vk::Buffer pixels(s.device, 4 * count, vk::Memory::readback);
  vk::Commands commands(s.device);
  vk::copy_from_image(commands, from, pixels);
  (void)s.device.run(commands);
  const auto words = pixels.read<std::uint32_t>(count);
  Image8 picture{from.width, from.height, std::vector<std::uint8_t>(3 * count)};
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t byte = s.targets[eye].blue_first ? 2 - c : c;
      picture.rgb[3 * i + c] = static_cast<std::uint8_t>((words[i] >> (8 * byte)) & 255U);
    }
  }
  return picture;
}

}  // namespace render
