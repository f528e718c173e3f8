// The stages of approximate defocus.
#include "render/frame_blur.hpp"

#include "render/frame_job.hpp"

namespace render {
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
                            .encode = !config_.keep_radiance,
                            .listed_tiles = variant_.listed_tiles};
  const vk::Buffer& blurred = config_.keep_radiance ? out_.radiance : out_.display;
  // Views share the memory of what is known of their tiles.
  for (data_.view.x = 0; data_.view.x < data_.size.z; ++data_.view.x) {
    commands.barrier();
    if (blurs) {
      find_layers(commands, variant);
    }
    dispatch_view(commands, kernels_.get(Stage::blur, variant),
                  {&out_.pixels, &blurred, &out_.blur_levels, &out_.blur_reaches, &out_.blur_squares});
    if (blurs) {
      dispatch_list(commands, kernels_.get(Stage::blur_layers, variant),
                    {&out_.pixels, &blurred, &out_.blur_reaches, &out_.list, &out_.blur_nearest}, out_.list);
    }
  }
  commands.timestamp("blur");
}

// Lists the tiles of a view in which a blur reaches across depth.
void FrameJob::find_layers(vk::Commands& commands, const BlurVariant& variant) {
  data_.limits.w = half_pupil_px_[static_cast<std::size_t>(data_.view.x)];
  empty_list(commands, out_.list);
  commands.fill_zero(out_.blur_widest);
  commands.barrier();
  dispatch_squares(commands, kernels_.get(Stage::blur_tiles, variant),
                   {&out_.pixels, &out_.blur_tiles, &out_.blur_levels, &out_.blur_nearest, &out_.blur_widest},
                   gpu::kBlurTile);
  commands.barrier();
  dispatch_squares(commands, kernels_.get(Stage::blur_reach, variant),
                   {&out_.pixels, &out_.blur_tiles, &out_.blur_reaches, &out_.list, &out_.blur_widest}, gpu::kBlurTile);
  commands.barrier();
  if (variant.rate > 1) {
    dispatch_squares(commands, kernels_.get(Stage::blur_squares, variant),
                     {&out_.pixels, &out_.blur_squares, &out_.blur_levels, &out_.blur_reaches}, 2);
    commands.barrier();
  }
}

}  // namespace render
