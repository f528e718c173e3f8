// One frame in the making: its settings on the device, and the recording of each stage.
#pragma once

#include <optional>
#include <vector>

#include "lenses/lens_model.hpp"
#include "render/frame_buffers.hpp"
#include "render/frame_types.hpp"
#include "render/kernel_set.hpp"
#include "render/lens_forms/corner_grid.hpp"
#include "render/renderer.hpp"
#include "render/vk/commands.hpp"

namespace render {

class FrameJob {
 public:
  // What is referred to must outlive the job. traversal: not automatic.
  FrameJob(vk::Device& device, const SceneBuffers& scene, KernelSet& kernels, FrameBuffers& out,
           const lenses::LensModel& lenses, const std::vector<ViewSetup>& views, const FrameConfig& config,
           Traversal traversal);

  void set_range(const MapRange& range);

  // From now on the views are those in `from` (view_data) whenever the commands run: other poses, the same lenses.
  void record_views(vk::Commands& commands, const vk::Buffer& from);
  void record_double_views(vk::Commands& commands, const vk::Buffer& from);  // double_views(); where they are used
  // Every stage of a picture up to where the host must look at it (encodes_later), else to the end; not shown: linear
  // radiance is all that is wanted of it.
  void record_picture(vk::Commands& commands, bool shown = true);

  void record_trace(vk::Commands& commands);
  void record_edges(vk::Commands& commands);
  void record_blur(vk::Commands& commands);
  void record_encode(vk::Commands& commands);
  void record_sample(vk::Commands& commands, int index);

 private:
  using Buffers = std::vector<const vk::Buffer*>;

  void aim(vk::Commands& commands);
  void trace_corners(vk::Commands& commands);
  void aim_cubics(vk::Commands& commands, const Buffers& buffers);
  void empty_rough_lists(vk::Commands& commands);
  void dispatch_rough_view(vk::Commands& commands, Stage stage, Buffers buffers);
  void dispatch_rough(vk::Commands& commands, Stage stage, const Buffers& buffers);
  void find_hits(vk::Commands& commands);
  void empty_blur_lists(vk::Commands& commands);
  void blur_tiles(vk::Commands& commands, const BlurVariant& variant, const vk::Buffer& blurred);
  void dispatch_view(vk::Commands& commands, const vk::Kernel& kernel, const Buffers& buffers);
  void dispatch_blocks(vk::Commands& commands, const vk::Kernel& kernel, const Buffers& buffers);
  void dispatch_tiles(vk::Commands& commands, const vk::Kernel& kernel, Buffers buffers, int side,
                      std::size_t counts_at);
  void dispatch(vk::Commands& commands, const vk::Kernel& kernel, const Buffers& buffers);
  void dispatch_squares(vk::Commands& commands, const vk::Kernel& kernel, const Buffers& buffers, int side);
  void dispatch_list(vk::Commands& commands, const vk::Kernel& kernel, const Buffers& buffers, const vk::Buffer& list);
  void empty_list(vk::Commands& commands, vk::Buffer& list);
  void trace_with(vk::Commands& commands, Stage stage, const Buffers& own);
  [[nodiscard]] Buffers with_scene(const Buffers& own) const;

  const SceneBuffers& scene_;
  KernelSet& kernels_;
  FrameBuffers& out_;
  const FrameConfig& config_;
  Traversal traversal_;
  const vk::Buffer* accelerated_ = nullptr;  // where rays are traced by ray queries
  vk::Buffer table_, views_;
  std::optional<vk::Buffer> double_table_, double_views_;  // where the lens is traced in double precision
  CornerGrid corners_;
  bool trace_corners_ = false;          // of each frame anew; a field's may be known
  bool cubic_rays_ = false;             // of smooth tiles (lens_forms/tile_cubics.hpp)
  std::optional<vk::Buffer> no_tiles_;  // what lists of rough tiles begin as, where smooth tiles' rays are cubics
  TraceVariant variant_;
  gpu::FrameData data_{};
  std::vector<float> half_pupil_px_;  // of each view: what the pupil's half spans at a dioptre, px
};

// Views as the kernels take them, kMostViews of them.
[[nodiscard]] std::vector<gpu::ViewData> view_data(const lenses::LensModel& lenses,
                                                   const std::vector<ViewSetup>& views);

// Whether samples or a map's range come between the picture's trace and its encoding.
[[nodiscard]] bool encodes_later(const FrameConfig& config);

// Whether a frame of these settings has every pixel's wavefront in memory. Distributed rays need chief rays to go
// before them where each pixel has a focus of its own.
[[nodiscard]] bool keeps_wavefront(const FrameConfig& config, const std::vector<ViewSetup>& views);

// Whether the rays through a lens of this accuracy come with their ray-transfer matrices, so that no later kernel has
// to know the lens's form.
[[nodiscard]] bool keeps_transfer(const LensAccuracy& lens);

// What a frame of these views needs. traversal: not automatic.
[[nodiscard]] FrameBuffers::Size buffers_for(const FrameConfig& config, const std::vector<ViewSetup>& views,
                                             Traversal traversal);

}  // namespace render
