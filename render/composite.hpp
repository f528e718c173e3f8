// Pictures with fewer traced pixels than shown ones: Accuracy::resolution everywhere, Accuracy::foveation away from the
// gaze. They are drawn as one or two layers, each a picture of its own, and put together by one kernel:
//   whole   all of the field of view at the lower resolution
//   fovea   the part of it around the gaze; beyond what is shown of it lies as much more as a blur reaches
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "render/frame_buffers.hpp"
#include "render/frame_types.hpp"
#include "render/renderer.hpp"
#include "render/vk/commands.hpp"
#include "render/vk/kernel.hpp"

namespace render {

struct CompositeLayer {
  FrameConfig config;              // of the size that is traced
  std::vector<ViewSetup> views;    // with the layer's part of the field of view
  std::vector<glm::ivec2> origin;  // a view: the upper left corner in the picture, px
  glm::ivec2 extent{0};            // in the picture, px
};

struct CompositePlan {
  CompositeLayer whole;
  std::optional<CompositeLayer> fovea;  // none where the gaze is out of the picture
};

// Maps are always drawn in full.
[[nodiscard]] bool is_composed(const FrameConfig& config);

// Of views that stay where they are.
[[nodiscard]] CompositePlan plan_composite(const FrameConfig& config, const std::vector<ViewSetup>& views);
// For gazes that move: the layers' sizes suit a gaze straight ahead and some way aside; further aside the fovea is
// smaller. aim_composite says where they lie now.
[[nodiscard]] CompositePlan plan_moving_composite(const FrameConfig& config, const std::vector<ViewSetup>& views);
void aim_composite(CompositePlan& plan, const FrameConfig& config, const std::vector<ViewSetup>& views);

// 1 where the fovea's layer is shown alone, 0 where the whole's is; by the angle between a direction and the gaze.
struct FoveaFade {
  double cos_inner = 1.0, cos_outer = 1.0;
};
[[nodiscard]] FoveaFade fovea_fade(const Foveation& foveation);

// What the kernel is told, kMostViews of them.
[[nodiscard]] std::vector<gpu::CompositeData> composite_data(const CompositePlan& plan, const FrameConfig& config,
                                                             const std::vector<ViewSetup>& views);

// Layers drawn as the plan says, all views.
struct DrawnLayers {
  const FrameBuffers& whole;
  const FrameBuffers* fovea;  // null: none
};

class Compositor {
 public:
  explicit Compositor(vk::Device& device) : device_(device) {}

  // data: composite_data, read whenever the commands run. radiance may be anything where it is not wanted.
  void record(vk::Commands& commands, const FrameConfig& config, std::size_t views, const vk::Buffer& data,
              const DrawnLayers& layers, const vk::Buffer& radiance, const vk::Buffer& display);

 private:
  vk::Device& device_;
  std::optional<vk::Kernel> kernel_;
};

// The nearest traced pixel of the layer that a shown one has most of.
[[nodiscard]] WavefrontPlanes composed_wavefront(const CompositePlan& plan, const FrameConfig& config,
                                                 const std::vector<ViewSetup>& views, const DrawnLayers& layers,
                                                 std::size_t index);

}  // namespace render
