// Renders the views of one or two eyes on the device, both in one submission. The stages, each one kernel:
//   rays, tile  what every chief ray meets, many rays together, where that is faster (traversal.hpp)
//   trace   one chief ray a pixel: pupil, back, front, scene; vergence, accommodation, residual, blur ellipse
//   edges   the parts of a pixel that its faces have, a ray for each not met yet; more rays where light has edges
//   blur    approximate defocus (mode adof)          or   samples   distributed rays (mode dof)
//   encode  linear radiance to sRGB, or a wavefront map to colours
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/accuracy.hpp"
#include "render/image/image.hpp"
#include "render/scene_buffers.hpp"
#include "render/traversal.hpp"
#include "render/view_setup.hpp"
#include "render/vk/device.hpp"

namespace render {

enum class Mode { pinhole, adof, dof, power, astigmatism, accommodation, blur };

[[nodiscard]] bool is_map(Mode mode);

struct MapRange {
  double low = 0.0, high = 1.0;
};

struct FrameConfig {
  int width = 1024, height = 1024;  // of each view, pixels
  Mode mode = Mode::adof;
  Accuracy accuracy;
  double threshold_px = 0.5;           // blurs with a smaller major semi-axis are not drawn
  double exposure = 0.0;               // EV
  int samples = 64;                    // dof; with a target error the most that are taken
  int samples_before = 0;              // dof: of these, how many the frame before took of the same views and settings
  std::optional<double> target_error;  // dof: standard error of the mean luminance, rms over the picture
  std::uint32_t seed = 0;
  int colour_map = 0;             // 0: the paper's hue, 1: perceptual
  std::optional<MapRange> range;  // absent: from the picture
  bool bare = false;              // as the paper drew: base colours, one light, no shadow rays, one ray a pixel
  bool keep_radiance = false;     // also return linear radiance
  bool keep_wavefront = false;    // also return the wavefront of every pixel
};

// What reached the pupil for every pixel of a view; a rim has depth -1 and zeroes.
struct WavefrontPlanes {
  std::vector<float> v_hh, v_hv, v_vv, accommodation, blur, depth;  // D, D, D, D, rad, m
};

struct RenderedView {
  Image8 display;
  std::vector<float> radiance;  // r, g, b a pixel, linear, without exposure
  WavefrontPlanes wavefront;
};

struct RenderedFrame {
  std::vector<RenderedView> views;
  std::vector<vk::StageTime> stages;
  MapRange range;               // of a map
  int samples = 1;              // in the picture (dof)
  double error_estimate = 0.0;  // dof: see FrameConfig::target_error
};

using Progress = std::function<void(int done, int of)>;

class KernelSet;
struct RendererParts {
  vk::Device& device;
  const SceneBuffers& scene;
  KernelSet& kernels;
  Traversal traversal;
};

class Renderer {
 public:
  Renderer(vk::Device& device, const Scene& scene, const RendererConfig& config = {});
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) = delete;
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  // Views that do not fit the device's buffers together are rendered one after the other. Throws vk::DeviceError, also
  // for a size that one view alone cannot have. Distributed rays can go on where the frame before ended, so that a
  // picture that stands still becomes better: std::invalid_argument if it has not taken samples_before.
  [[nodiscard]] RenderedFrame render(const lenses::LensModel& lenses, const std::vector<ViewSetup>& views,
                                     const FrameConfig& config, const Progress& progress = {});

  // Compiles what frames of these settings need, whatever their size, and measures what has to be measured, so that no
  // frame of a running picture waits for it.
  void prepare(const lenses::LensModel& lenses, const std::vector<ViewSetup>& views, const FrameConfig& config);

  [[nodiscard]] std::size_t kernels_made() const;

  // For the other files of this folder: what frames are made with, and how those of these settings find the scene.
  [[nodiscard]] RendererParts parts(const lenses::LensModel& lenses, const std::vector<ViewSetup>& views,
                                    const FrameConfig& config);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace render
