// Pictures with fewer traced pixels than shown ones: Accuracy::resolution everywhere, Accuracy::foveation away from the
// gaze. They are drawn as one or two layers, each a picture of its own, and put together by one kernel:
//   whole   all of the field of view at the lower resolution
//   fovea   the part of it around the gaze; beyond what is shown of it lies as much more as a blur reaches
#pragma once

#include <glm/vec2.hpp>
#include <memory>
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

[[nodiscard]] CompositePlan plan_composite(const FrameConfig& config, const std::vector<ViewSetup>& views);

// 1 where the fovea's layer is shown alone, 0 where the whole's is; by the angle between a direction and the gaze.
struct FoveaFade {
  double cos_inner = 1.0, cos_outer = 1.0;
};
[[nodiscard]] FoveaFade fovea_fade(const Foveation& foveation);

class Compositor {
 public:
  // Layers drawn as the plan says, all views.
  struct Layers {
    const FrameBuffers& whole;
    const FrameBuffers* fovea;  // null: none
  };

  explicit Compositor(vk::Device& device) : device_(device) {}

  void record(vk::Commands& commands, const CompositePlan& plan, const FrameConfig& config,
              const std::vector<ViewSetup>& views, const Layers& layers);
  // After the commands have run.
  [[nodiscard]] RenderedView read(const CompositePlan& plan, const FrameConfig& config,
                                  const std::vector<ViewSetup>& views, const Layers& layers, std::size_t index) const;

 private:
  struct Out {
    std::size_t pixels;
    vk::Buffer radiance, display;
  };
  void make_room(std::size_t pixels);

  vk::Device& device_;
  std::optional<vk::Kernel> kernel_;
  std::unique_ptr<Out> out_;
};

}  // namespace render
