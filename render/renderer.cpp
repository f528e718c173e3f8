#include "render/renderer.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "render/frame_buffers.hpp"
#include "render/frame_types.hpp"
#include "render/gpu_tracer.hpp"
#include "render/kernel_set.hpp"
#include "render/map_range.hpp"
#include "render/vk/commands.hpp"

namespace render {
namespace {

constexpr std::uint32_t kTile = 8;          // local size of the frame's kernels
constexpr int kSamplesASubmission = 8;      // dof
constexpr int kFewestSamplesToStopOn = 16;  // below, the error estimate itself is too rough
constexpr float kLargestBlur = 512.0F;      // px; beyond it nothing is left to see
constexpr int kMeasuredSide = 256;          // pixels; of the pictures that choose a traversal
constexpr float kNoBlurDrawn = 1e9F;        // px, as a threshold

std::size_t pixels_of(const FrameConfig& config) {
  return static_cast<std::size_t>(config.width) * static_cast<std::size_t>(config.height);
}

bool keeps_wavefront(const FrameConfig& config) {
  return is_map(config.mode) || config.mode == Mode::dof || config.keep_wavefront;
}

double rms_standard_error(const std::vector<glm::vec4>& sums, int samples) {
  double total = 0.0;
  const double n = samples;
  for (const glm::vec4& s : sums) {
    const double mean = (0.2126 * s.x + 0.7152 * s.y + 0.0722 * s.z) / n;
    total += std::max(0.0, s.w / n - mean * mean) / n;
  }
  return std::sqrt(total / static_cast<double>(std::max<std::size_t>(sums.size(), 1)));
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

// One frame in the making: its settings on the device and the recording of each stage.
class FrameJob {
 public:
  FrameJob(vk::Device& device, const SceneBuffers& scene, KernelSet& kernels, FrameBuffers& out,
           const lenses::LensModel& lenses, const std::vector<ViewSetup>& views, const FrameConfig& config, bool tile)
      : device_(device),
        scene_(scene),
        kernels_(kernels),
        out_(out),
        config_(config),
        table_(filled_buffer(device, lenses::to_float(lenses.table))),
        views_(filled_buffer(device, view_data(lenses, views))) {
    std::vector<lenses::f64::LensData> worn;
    for (const ViewSetup& view : views) {
      worn.push_back(lenses.lens[view.lens]);
    }
    variant_ = {surface_kinds(worn), config.shadows, config.mode != Mode::pinhole || config.keep_wavefront,
                keeps_wavefront(config), tile};
    data_.size = glm::ivec4(config.width, config.height, static_cast<int>(views.size()), static_cast<int>(config.mode));
    data_.sampling = glm::ivec4(0, 0, static_cast<int>(config.seed), config.colour_map);
    // A pinhole picture is the defocused one with nothing left to blur.
    const float threshold = config.mode == Mode::adof ? static_cast<float>(config.threshold_px) : kNoBlurDrawn;
    data_.limits = glm::vec4(threshold, kLargestBlur, std::exp2(static_cast<float>(config.exposure)), 0.0F);
  }

  void set_range(const MapRange& range) {
    data_.map_range = glm::vec4(static_cast<float>(range.low), static_cast<float>(range.high),
                                static_cast<float>(map_unit_factor(config_.mode)), 0.0F);
  }

  void record_trace(vk::Commands& commands) {
    if (variant_.tile) {
      find_hits_by_tile(commands);
    }
    trace_with(commands, Stage::chief, {&out_.pixels, &out_.keys, &out_.wavefronts, &out_.tile_hits});
    commands.timestamp("trace");
  }

  void record_edges_and_blur(vk::Commands& commands) {
    for (data_.view.x = 0; data_.view.x < data_.size.z; ++data_.view.x) {
      commands.barrier();
      commands.fill_zero(out_.list);
      commands.barrier();
      dispatch_view(commands, kernels_.get(Stage::find_edges), {&out_.pixels, &out_.keys, &out_.list});
      commands.barrier();
      dispatch_list(commands, kernels_.get(Stage::edges, variant_), with_scene({&out_.pixels, &out_.list}));
    }
    commands.timestamp("edges");
    commands.barrier();
    dispatch(commands, kernels_.get(Stage::blur), {&out_.pixels, &out_.radiance});
    commands.timestamp("blur");
  }

  void record_encode(vk::Commands& commands) {
    commands.barrier();
    dispatch(commands, kernels_.get(Stage::encode), {&out_.radiance, &out_.wavefronts, &out_.display});
    commands.timestamp("encode");
  }

  // Distributed rays until the samples or the target error are reached; results go into `frame`.
  void take_samples(RenderedFrame& frame, const Progress& progress) {
    frame.samples = 0;
    while (frame.samples < config_.samples) {
      const int batch = std::min(kSamplesASubmission, config_.samples - frame.samples);
      vk::Commands commands(device_);
      for (int i = 0; i < batch; ++i) {
        data_.sampling.x = frame.samples + i;
        trace_with(commands, Stage::samples, {&out_.wavefronts, &out_.sums, &out_.radiance});
        commands.barrier();
      }
      commands.timestamp("samples");
      add_times(frame.stages, device_.run(commands));
      frame.samples += batch;
      frame.error_estimate = rms_standard_error(out_.sums.read<glm::vec4>(out_.count), frame.samples);
      if (progress) {
        progress(frame.samples, config_.samples);
      }
      if (config_.target_error && frame.samples >= kFewestSamplesToStopOn &&
          frame.error_estimate <= *config_.target_error) {
        break;
      }
    }
  }

 private:
  static std::vector<gpu::ViewData> view_data(const lenses::LensModel& lenses, const std::vector<ViewSetup>& views) {
    std::vector<gpu::ViewData> data;
    for (const ViewSetup& view : views) {
      data.push_back(make_view_data(view, lenses));
    }
    data.resize(gpu::kMostViews);  // a uniform buffer has its full size
    return data;
  }

  using Buffers = std::vector<const vk::Buffer*>;

  // The view of data_.view.
  void dispatch_view(vk::Commands& commands, const vk::Kernel& kernel, const Buffers& buffers) {
    const auto groups = [](int pixels) { return (static_cast<std::uint32_t>(pixels) + kTile - 1) / kTile; };
    commands.dispatch(kernel, buffers, vk::bytes_of(data_), groups(data_.size.x), groups(data_.size.y));
  }

  void dispatch(vk::Commands& commands, const vk::Kernel& kernel, const Buffers& buffers) {
    for (data_.view.x = 0; data_.view.x < data_.size.z; ++data_.view.x) {
      dispatch_view(commands, kernel, buffers);
    }
  }

  void dispatch_list(vk::Commands& commands, const vk::Kernel& kernel, const Buffers& buffers) {
    commands.dispatch(kernel, buffers, vk::bytes_of(data_), gpu::kListWorkgroups);
  }

  [[nodiscard]] Buffers with_scene(const Buffers& own) const {
    Buffers all{&table_, &scene_.bvh_nodes,   &scene_.bvh_triangles, &scene_.shading_triangles, &scene_.texels,
                &views_, &scene_.environment, &scene_.lights,        &scene_.materials,         &scene_.textures};
    all.insert(all.end(), own.begin(), own.end());
    return all;
  }

  void trace_with(vk::Commands& commands, Stage stage, const Buffers& own) {
    dispatch(commands, kernels_.get(stage, variant_), with_scene(own));
  }

  void find_hits_by_tile(vk::Commands& commands) {
    commands.fill_zero(out_.list);
    trace_with(commands, Stage::rays, {&out_.ray_origins, &out_.ray_directions});
    commands.timestamp("rays");
    commands.barrier();
    dispatch(commands, kernels_.get(Stage::tile),
             {&out_.ray_origins, &out_.ray_directions, &scene_.wide_nodes, &scene_.bvh_triangles, &out_.tile_hits,
              &out_.list});
    commands.barrier();
    dispatch_list(commands, kernels_.get(Stage::left_out),
                  {&out_.ray_origins, &out_.ray_directions, &scene_.bvh_nodes, &scene_.bvh_triangles, &out_.tile_hits,
                   &out_.list});
    commands.timestamp("tile");
    commands.barrier();
  }

  vk::Device& device_;
  const SceneBuffers& scene_;
  KernelSet& kernels_;
  FrameBuffers& out_;
  const FrameConfig& config_;
  vk::Buffer table_, views_;
  TraceVariant variant_;
  gpu::FrameData data_{};
};

}  // namespace

struct Renderer::State {
  State(vk::Device& d, const Scene& scene, const RendererConfig& c)
      : device(d), config(c), buffers(d, scene), kernels(d) {}

  FrameBuffers& frame_buffers(std::size_t count, bool wavefront, bool sums, bool tile) {
    if (!frame || frame->count != count || (wavefront && !frame->has_wavefront) || (sums && !frame->has_sums) ||
        (tile && !frame->has_tile)) {
      frame.reset();  // the old one goes first, so that both never stand side by side
      frame = std::make_unique<FrameBuffers>(device, count, wavefront, sums, tile);
    }
    return *frame;
  }

  // Least of a few runs of the trace stage alone, ms.
  double measure(const lenses::LensModel& lenses, const std::vector<ViewSetup>& views, const FrameConfig& frame_config,
                 bool tile) {
    FrameBuffers out(device, pixels_of(frame_config) * views.size(), keeps_wavefront(frame_config), false, tile);
    FrameJob job(device, buffers, kernels, out, lenses, views, frame_config, tile);
    vk::Commands commands(device);
    job.record_trace(commands);
    device.run(commands);  // compiles
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i) {
      const auto start = std::chrono::steady_clock::now();
      device.run(commands);
      const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
      least = std::min(least, took.count());
    }
    return least;
  }

  Traversal faster(RayKind kind, const lenses::LensModel& lenses, const std::vector<ViewSetup>& views,
                   const FrameConfig& frame_config) {
    const auto known = chosen.find(kind);
    if (known != chosen.end()) {
      return known->second;
    }
    const TraversalRecord record(config.traversal_file, device.name());
    std::optional<Traversal> choice = record.find(kind);
    if (!choice) {
      FrameConfig small = frame_config;
      small.width = std::min(small.width, kMeasuredSide);
      small.height = std::min(small.height, kMeasuredSide);
      choice = measure(lenses, views, small, true) < measure(lenses, views, small, false) ? Traversal::tile
                                                                                          : Traversal::per_ray;
      record.keep(kind, *choice);
    }
    chosen[kind] = *choice;
    return *choice;
  }

  bool by_tile(const lenses::LensModel& lenses, const std::vector<ViewSetup>& views, const FrameConfig& frame_config) {
    const std::size_t count = pixels_of(frame_config) * views.size();
    if (config.traversal == Traversal::per_ray || !can_trace_tiles(device.limits()) ||
        count > device.limits().max_texel_elements) {
      return false;
    }
    if (config.traversal == Traversal::tile) {
      return true;
    }
    const bool bare =
        std::ranges::all_of(views, [&](const ViewSetup& view) { return lenses.lens[view.lens].glass.w == 0.0; });
    return faster(bare ? RayKind::bare : RayKind::refracted, lenses, views, frame_config) == Traversal::tile;
  }

  // All views in one submission, but for samples and for a map whose range the picture itself must tell.
  RenderedFrame render_together(const lenses::LensModel& lenses, const std::vector<ViewSetup>& views,
                                const FrameConfig& config, const Progress& progress) {
    const bool tile = by_tile(lenses, views, config);
    FrameBuffers& out =
        frame_buffers(pixels_of(config) * views.size(), keeps_wavefront(config), config.mode == Mode::dof, tile);
    FrameJob job(device, buffers, kernels, out, lenses, views, config, tile);
    RenderedFrame result;
    result.range = config.range.value_or(MapRange{});
    job.set_range(result.range);
    vk::Commands commands(device);
    job.record_trace(commands);
    if (config.mode == Mode::adof || config.mode == Mode::pinhole) {
      job.record_edges_and_blur(commands);
    }
    const bool encode_later = config.mode == Mode::dof || (is_map(config.mode) && !config.range);
    if (!encode_later) {
      job.record_encode(commands);
    }
    add_times(result.stages, device.run(commands));
    if (config.mode == Mode::dof) {
      job.take_samples(result, progress);
    } else if (encode_later) {
      result.range = map_range_of(config.mode, out.wavefronts.read<glm::vec4>(2 * out.count));
      job.set_range(result.range);
    }
    if (encode_later) {
      vk::Commands last(device);
      job.record_encode(last);
      add_times(result.stages, device.run(last));
    }
    for (std::size_t i = 0; i < views.size(); ++i) {
      result.views.push_back(read_view(out, config, i));
    }
    return result;
  }

  vk::Device& device;
  RendererConfig config;
  std::map<RayKind, Traversal> chosen;
  SceneBuffers buffers;
  KernelSet kernels;
  std::unique_ptr<FrameBuffers> frame;
};

Renderer::Renderer(vk::Device& device, const Scene& scene, const RendererConfig& config)
    : state_(std::make_unique<State>(device, scene, config)) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;

RenderedFrame Renderer::render(const lenses::LensModel& lenses, const std::vector<ViewSetup>& views,
                               const FrameConfig& config, const Progress& progress) {
  const std::size_t bytes_a_view = pixels_of(config) * (keeps_wavefront(config) ? kWavefrontBytes : kPixelBytes);
  const bool fits = bytes_a_view * views.size() <= state_->device.limits().max_storage_buffer_bytes;
  if (fits && views.size() <= static_cast<std::size_t>(gpu::kMostViews)) {
    return state_->render_together(lenses, views, config, progress);
  }
  // One after the other, with one range for all.
  RenderedFrame all;
  FrameConfig single = config;
  for (const ViewSetup& view : views) {
    RenderedFrame one = state_->render_together(lenses, {view}, single, progress);
    if (is_map(config.mode)) {
      single.range = one.range;
    }
    all.range = one.range;
    all.samples = one.samples;
    all.error_estimate = std::max(all.error_estimate, one.error_estimate);
    add_times(all.stages, one.stages);
    all.views.push_back(std::move(one.views.front()));
  }
  return all;
}

}  // namespace render
