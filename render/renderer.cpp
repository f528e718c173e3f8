#include "render/renderer.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "render/composite.hpp"
#include "render/frame_buffers.hpp"
#include "render/frame_job.hpp"
#include "render/frame_types.hpp"
#include "render/kernel_set.hpp"
#include "render/lens_forms/lens_form_cache.hpp"
#include "render/map_range.hpp"
#include "render/sample_error.hpp"
#include "render/shaders/sample_pattern.h"
#include "render/traversal_choice.hpp"
#include "render/vk/commands.hpp"

namespace render {
namespace {

constexpr int kSamplesASubmission = 8;  // dof
static_assert(gpu::kEvenSamples % kSamplesASubmission == 0);

std::size_t pixels_of(const FrameConfig& config) {
  return static_cast<std::size_t>(config.width) * static_cast<std::size_t>(config.height);
}

void add_times(std::vector<vk::StageTime>& sum, const std::vector<vk::StageTime>& more) {
  for (const vk::StageTime& stage : more) {
    const auto found = std::ranges::find(sum, stage.name, &vk::StageTime::name);
    if (found == sum.end()) {
      sum.push_back(stage);
    } else {
      found->milliseconds += stage.milliseconds;
    }
  }
}

}  // namespace

struct Renderer::State {
  State(vk::Device& d, const Scene& scene, const RendererConfig& config)
      : device(d), choice(d, config), buffers(d, scene), kernels(d) {}

  RenderedFrame render_together(const lenses::LensModel& lenses, const std::vector<ViewSetup>& views,
                                const FrameConfig& config, const Progress& progress) {
    return is_composed(config) ? compose(lenses, views, config, progress) : draw(lenses, views, config, progress);
  }

  // Each layer into buffers of its own.
  RenderedFrame compose(const lenses::LensModel& lenses, const std::vector<ViewSetup>& views, const FrameConfig& config,
                        const Progress& progress) {
    const CompositePlan plan = plan_composite(config, views);
    const auto drawn = [&](const CompositeLayer& layer, std::unique_ptr<FrameBuffers>& layer_frame) {
      std::swap(frame, layer_frame);
      RenderedFrame result = draw(lenses, layer.views, layer.config, progress, false);
      std::swap(frame, layer_frame);
      return result;
    };
    RenderedFrame result = drawn(plan.whole, whole_frame);
    if (plan.fovea) {
      add_times(result.stages, drawn(*plan.fovea, fovea_frame).stages);
    }
    const DrawnLayers layers{*whole_frame, plan.fovea ? fovea_frame.get() : nullptr};
    const std::size_t pixels = pixels_of(config) * views.size();
    const vk::Buffer data = filled_buffer(device, composite_data(plan, config, views));
    const vk::Buffer radiance(device, config.keep_radiance ? pixels * 8 : 8, vk::Memory::device);
    const vk::Buffer display(device, pixels * 4, vk::Memory::device);
    vk::Commands commands(device);
    compositor.record(commands, config, views.size(), data, layers, radiance, display);
    add_times(result.stages, device.run(commands));
    for (std::size_t i = 0; i < views.size(); ++i) {
      RenderedView& view = result.views.emplace_back();
      view.display = read_display(display, config, i);
      if (config.keep_radiance) {
        view.radiance = read_radiance(radiance, config, i);
      }
      if (config.keep_wavefront) {
        view.wavefront = composed_wavefront(plan, config, views, layers, i);
      }
    }
    return result;
  }

  // All views in one submission, but for samples and for a map whose range the picture itself must tell.
  RenderedFrame draw(const lenses::LensModel& worn, const std::vector<ViewSetup>& views, const FrameConfig& config,
                     const Progress& progress, bool read_back = true) {
    const lenses::LensModel& lenses = forms.in_form(worn, config.accuracy.lens);
    const Traversal traversal = choice.for_frame(device, buffers, kernels, lenses, views, config);
    FrameBuffers& out = frame_buffers(buffers_for(config, views, traversal));
    FrameJob job(device, buffers, kernels, out, lenses, views, config, traversal);
    RenderedFrame result;
    result.range = config.range.value_or(MapRange{});
    job.set_range(result.range);
    vk::Commands commands(device);
    job.record_picture(commands, read_back);
    add_times(result.stages, device.run(commands));
    if (config.mode == Mode::dof) {
      take_samples(job, out, config, result, progress);
    } else if (encodes_later(config)) {
      result.range = map_range_of(config.mode, out.wavefronts.read<glm::vec4>(2 * out.size.pixels));
      job.set_range(result.range);
    }
    if (encodes_later(config)) {
      vk::Commands last(device);
      job.record_encode(last);
      add_times(result.stages, device.run(last));
    }
    for (std::size_t i = 0; read_back && i < views.size(); ++i) {
      result.views.push_back(read_view(out, config, i));
    }
    return result;
  }

  // Distributed rays until the samples or the target error are reached; results go into `frame`.
  void take_samples(FrameJob& job, FrameBuffers& out, const FrameConfig& config, RenderedFrame& frame,
                    const Progress& progress) {
    if (config.samples_before != 0 && config.samples_before != out.samples) {
      throw std::invalid_argument("the frame before took other samples");
    }
    frame.samples = config.samples_before;
    while (frame.samples < config.samples) {
      const int batch = std::min(kSamplesASubmission, config.samples - frame.samples);
      vk::Commands commands(device);
      for (int i = 0; i < batch; ++i) {
        job.record_sample(commands, frame.samples + i);
      }
      add_times(frame.stages, device.run(commands));
      frame.samples += batch;
      out.samples = frame.samples;
      if (progress) {
        progress(frame.samples, config.samples);
      }
      const bool even = frame.samples % gpu::kEvenSamples == 0;  // between, the estimate is worth less
      if ((config.target_error && even) || frame.samples == config.samples) {
        frame.error_estimate = rms_standard_error(out.sums.read<glm::vec4>(out.size.pixels), frame.samples);
        if (config.target_error && frame.error_estimate <= *config.target_error) {
          break;
        }
      }
    }
  }

  FrameBuffers& frame_buffers(const FrameBuffers::Size& size) {
    if (!frame || !frame->size.holds(size)) {
      frame.reset();  // the old one goes first, so that both never stand side by side
      frame = std::make_unique<FrameBuffers>(device, size);
    }
    return *frame;
  }

  vk::Device& device;
  TraversalChoice choice;  // before the scene: it refuses what the device cannot
  SceneBuffers buffers;
  KernelSet kernels;
  Compositor compositor{device};
  LensFormCache forms;
  std::unique_ptr<FrameBuffers> frame, whole_frame, fovea_frame;
};

Renderer::Renderer(vk::Device& device, const Scene& scene, const RendererConfig& config)
    : state_(std::make_unique<State>(device, scene, config)) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;

RenderedFrame Renderer::render(const lenses::LensModel& lenses, const std::vector<ViewSetup>& views,
                               const FrameConfig& config, const Progress& progress) {
  const std::size_t bytes_a_pixel = keeps_transfer(config.accuracy.lens) ? kTransferBytes
                                    : keeps_wavefront(config, views)     ? kWavefrontBytes
                                                                         : kPixelBytes;
  const std::size_t bytes_a_view = pixels_of(config) * bytes_a_pixel;
  const bool fits = bytes_a_view * views.size() <= state_->device.limits().max_storage_buffer_bytes;
  if (fits && views.size() <= static_cast<std::size_t>(gpu::kMostViews)) {
    return state_->render_together(lenses, views, config, progress);
  }
  if (config.samples_before != 0) {
    throw std::invalid_argument("views that do not fit together cannot go on with their samples");
  }
  // One after the other. A map's range spans them all, so it is found before any is coloured.
  RenderedFrame all;
  FrameConfig single = config;
  if (is_map(config.mode) && !config.range) {
    for (const ViewSetup& view : views) {
      const MapRange range = state_->render_together(lenses, {view}, config, progress).range;
      single.range = single.range
                         ? MapRange{std::min(single.range->low, range.low), std::max(single.range->high, range.high)}
                         : range;
    }
  }
  for (const ViewSetup& view : views) {
    RenderedFrame one = state_->render_together(lenses, {view}, single, progress);
    all.range = one.range;
    all.samples = one.samples;
    all.error_estimate = std::max(all.error_estimate, one.error_estimate);
    add_times(all.stages, one.stages);
    all.views.push_back(std::move(one.views.front()));
  }
  return all;
}

// Drivers compile at the first dispatch, some of them: so it takes a frame, if a small one. Its pixels are as large as
// those of the picture: which kernels draw it may depend on them (lens_forms/tile_cubics.hpp).
void Renderer::prepare(const lenses::LensModel& lenses, const std::vector<ViewSetup>& views,
                       const FrameConfig& config) {
  constexpr int kSide = 8;
  FrameConfig small = config;
  small.width = small.height = kSide;
  small.samples = 1;
  std::vector<ViewSetup> parts = views;
  for (ViewSetup& view : parts) {
    const double across = static_cast<double>(kSide) / config.width, up = static_cast<double>(kSide) / config.height;
    const tracking::FieldOfView& fov = view.view.fov;
    view.view.fov = {fov.tan_left * across, fov.tan_right * across, fov.tan_down * up, fov.tan_up * up};
  }
  (void)render(lenses, parts, small);
}

RendererParts Renderer::parts(const lenses::LensModel& lenses, const std::vector<ViewSetup>& views,
                              const FrameConfig& config) {
  State& s = *state_;
  const lenses::LensModel& worn = s.forms.in_form(lenses, config.accuracy.lens);
  return {s.device, s.buffers, s.kernels, s.choice.for_frame(s.device, s.buffers, s.kernels, worn, views, config)};
}

std::size_t Renderer::kernels_made() const {
  return state_->kernels.size();
}

}  // namespace render
