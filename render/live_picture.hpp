// A picture of all views in the making, over and over: a running frame itself, or a layer of it.
#pragma once

#include <vector>

#include "lenses/lens_model.hpp"
#include "render/frame_buffers.hpp"
#include "render/renderer.hpp"
#include "render/vk/commands.hpp"

namespace render {

struct LivePicture {
  // masked: tiles that nobody sees are left out.
  LivePicture(const RendererParts& parts, const FrameConfig& frame, const std::vector<ViewSetup>& views, bool masked);

  // For the next time that what was recorded runs; the lenses in the form that the picture uses.
  void write_views(const lenses::LensModel& lenses, const std::vector<ViewSetup>& views);
  // shown: encoded for a display, else its radiance goes on to be composed.
  void record(vk::Commands& commands, const RendererParts& parts, const lenses::LensModel& lenses,
              const std::vector<ViewSetup>& views, bool shown);

  FrameConfig config;
  FrameBuffers buffers;
  vk::Buffer upload, double_upload;
};

}  // namespace render
