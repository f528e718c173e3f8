// Which traversal finds what a frame's chief rays meet: the faster by a short measurement, which is kept.
#pragma once

#include <map>
#include <vector>

#include "render/kernel_set.hpp"
#include "render/renderer.hpp"

namespace render {

class TraversalChoice {
 public:
  // Asked for ray queries on a device without them: vk::DeviceError.
  TraversalChoice(const vk::Device& device, RendererConfig config);

  // Never automatic. Measures the first time that a device traces this kind of ray.
  [[nodiscard]] Traversal for_frame(vk::Device& device, const SceneBuffers& scene, KernelSet& kernels,
                                    const lenses::LensModel& lenses, const std::vector<ViewSetup>& views,
                                    const FrameConfig& frame);

 private:
  RendererConfig config_;
  std::map<RayKind, Traversal> known_;
};

}  // namespace render
