#include "render/live_picture.hpp"

#include <glm/vec4.hpp>

#include "render/frame_job.hpp"
#include "render/lens_forms/double_view.hpp"
#include "render/shown_tiles.hpp"

namespace render {
namespace {

FrameBuffers::Size size_of(const RendererParts& parts, const FrameConfig& frame, const std::vector<ViewSetup>& views,
                           bool masked) {
  FrameBuffers::Size size = buffers_for(frame, views, parts.traversal);
  size.listed_tiles = masked ? listed_tile_words(frame.width, frame.height) * views.size() : 0;
  return size;
}

}  // namespace

LivePicture::LivePicture(const RendererParts& parts, const FrameConfig& frame, const std::vector<ViewSetup>& views,
                         bool masked)
    : config(frame),
      buffers(parts.device, size_of(parts, frame, views, masked)),
      upload(parts.device, sizeof(gpu::ViewData) * static_cast<std::size_t>(gpu::kMostViews), vk::Memory::upload),
      double_upload(parts.device, sizeof(glm::dvec4) * double_views({}, {}).size(), vk::Memory::upload) {}

void LivePicture::write_views(const lenses::LensModel& lenses, const std::vector<ViewSetup>& views) {
  upload.write(view_data(lenses, views));
  if (config.accuracy.lens.in_double) {
    double_upload.write(double_views(views, lenses));
  }
}

void LivePicture::record(vk::Commands& commands, const RendererParts& parts, const lenses::LensModel& lenses,
                         const std::vector<ViewSetup>& views, bool shown) {
  FrameJob job(parts.device, parts.scene, parts.kernels, buffers, lenses, views, config, parts.traversal);
  job.set_range(config.range.value_or(MapRange{}));
  job.record_views(commands, upload);
  job.record_double_views(commands, double_upload);
  job.record_picture(commands, shown);
  if (config.mode == Mode::dof) {
    for (int i = 0; i < config.samples; ++i) {
      job.record_sample(commands, i);
    }
    commands.timestamp("samples");
    if (shown) {
      job.record_encode(commands);
    }
  }
}

}  // namespace render
