// The stages of approximate defocus.
#include "render/frame_blur.hpp"

#include <array>
#include <span>

#include "render/frame_job.hpp"

namespace render {
namespace {

// Workgroups of an invocation a tile.
std::uint32_t tile_groups(int pixels) {
  constexpr int kPixels = 8 * gpu::kBlurTile;
  return static_cast<std::uint32_t>((pixels + kPixels - 1) / kPixels);
}

}  // namespace

std::size_t blur_tiles(int width, int height) {
  const auto along = [](int pixels) {
    return static_cast<std::size_t>((pixels + gpu::kBlurTile - 1) / gpu::kBlurTile);
  };
  return along(width) * along(height);
}

std::vector<float> half_pupils_px(const std::vector<ViewSetup>& views, int width) {
  std::vector<float> spans;
  for (const ViewSetup& view : views) {
    const tracking::FieldOfView& fov = view.view.fov;
    spans.push_back(static_cast<float>(0.5 * view.eye.pupil.x * width / (fov.tan_left + fov.tan_right)));
  }
  return spans;
}

void FrameJob::record_blur(vk::Commands& commands) {
  const bool blurs = config_.mode == Mode::adof;
  const BlurAccuracy& accuracy = config_.accuracy.blur;
  const BlurVariant variant{.taps = blurs ? static_cast<std::uint32_t>(accuracy.taps) : 0U,
                            .gaussian = accuracy.kernel == BlurKernel::gaussian,
                            .rate = accuracy.rate,
                            .encode = !config_.keep_radiance};
  const vk::Buffer& blurred = config_.keep_radiance ? out_.radiance : out_.display;
  // Views share the memory of what is known of their tiles.
  for (data_.view.x = 0; data_.view.x < data_.size.z; ++data_.view.x) {
    if (blurs) {
      data_.limits.w = half_pupil_px_[static_cast<std::size_t>(data_.view.x)];
      empty_blur_lists(commands);
    }
    commands.barrier();
    dispatch_squares(commands, kernels_.get(Stage::blur_tiles, variant),
                     {&out_.pixels, &blurred, &out_.blur_tiles, &out_.blur_wide}, gpu::kBlurTile);
    if (blurs) {
      blur_tiles(commands, variant, blurred);
    }
  }
  commands.timestamp("blur");
}

void FrameJob::empty_blur_lists(vk::Commands& commands) {
  commands.barrier();
  const std::array<std::uint32_t, 4> no_groups{0, tile_groups(data_.size.y), 1, 0};
  commands.update(out_.blur_wide, std::as_bytes(std::span(no_groups)));
  commands.fill_zero(out_.blur_sources);
  empty_list(commands, out_.blur_layered);
  empty_list(commands, out_.blur_wide_layered);
  empty_list(commands, out_.blur_blurred);
  empty_list(commands, out_.blur_narrow);
  empty_list(commands, out_.blur_squared);
}

// Tiles that are not in focus.
void FrameJob::blur_tiles(vk::Commands& commands, const BlurVariant& variant, const vk::Buffer& blurred) {
  BlurVariant wide = variant;
  wide.wide = true;
  commands.barrier();
  dispatch_squares(
      commands, kernels_.get(Stage::blur_reach, variant),
      {&out_.pixels, &out_.blur_tiles, &out_.blur_reaches, &out_.blur_wide, &out_.blur_layered, &out_.blur_blurred,
       &out_.blur_narrow, &out_.blur_squared, &out_.blur_wide_layered, &out_.blur_sources},
      gpu::kBlurTile);
  dispatch_list(commands, kernels_.get(Stage::blur_levels, variant),
                {&out_.pixels, &out_.blur_levels, &out_.blur_wide, &out_.blur_sources}, out_.blur_wide);
  commands.barrier();
  if (variant.rate > 1) {
    dispatch_list(commands, kernels_.get(Stage::blur_squares, wide),
                  {&out_.blur_levels, &out_.blur_squares, &out_.blur_reaches, &out_.blur_squared}, out_.blur_squared);
    commands.barrier();
  }
  dispatch_list(commands, kernels_.get(Stage::blur_narrow, variant), {&out_.pixels, &blurred, &out_.blur_narrow},
                out_.blur_narrow);
  dispatch_list(commands, kernels_.get(Stage::blur, wide),
                {&out_.blur_levels, &blurred, &out_.blur_squares, &out_.blur_blurred}, out_.blur_blurred);
  dispatch_list(commands, kernels_.get(Stage::blur_layers, variant),
                {&out_.pixels, &blurred, &out_.blur_reaches, &out_.blur_layered}, out_.blur_layered);
  dispatch_list(commands, kernels_.get(Stage::blur_layers, wide),
                {&out_.blur_levels, &blurred, &out_.blur_reaches, &out_.blur_wide_layered}, out_.blur_wide_layered);
}

}  // namespace render
