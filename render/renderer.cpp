#include "render/renderer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/packing.hpp>
#include <numbers>

#include "render/frame_types.hpp"
#include "render/gpu_tracer.hpp"
#include "render/vk/commands.hpp"
#include "render/vk/kernel.hpp"
#include "shaders/blur.hpp"
#include "shaders/chief.hpp"
#include "shaders/dof.hpp"
#include "shaders/edges.hpp"
#include "shaders/encode.hpp"

namespace render {
namespace {

constexpr std::uint32_t kTile = 8;            // local size of the frame's kernels
constexpr int kSamplesASubmission = 8;        // dof
constexpr float kLargestBlur = 512.0F;        // px; beyond it nothing is left to see
constexpr std::size_t kPixelBytes = 16, kWavefrontBytes = 32;

constexpr std::array kSceneBindings{
    vk::Binding::texel_rgba32f,  vk::Binding::texel_rgba32ui, vk::Binding::texel_rgba32f, vk::Binding::texel_rgba32f,
    vk::Binding::texel_r32ui,    vk::Binding::uniform_buffer, vk::Binding::uniform_buffer, vk::Binding::storage_buffer,
    vk::Binding::storage_buffer, vk::Binding::storage_buffer};

std::vector<vk::Binding> scene_and(int storage_buffers) {
  std::vector<vk::Binding> bindings(kSceneBindings.begin(), kSceneBindings.end());
  bindings.insert(bindings.end(), static_cast<std::size_t>(storage_buffers), vk::Binding::storage_buffer);
  return bindings;
}

// The buffers of one size of frame.
struct FrameBuffers {
  FrameBuffers(const vk::Device& device, std::size_t pixel_count, bool wavefront, bool sums)
      : count(pixel_count),
        has_wavefront(wavefront),
        has_sums(sums),
        pixels(device, count * kPixelBytes, vk::Memory::device),
        keys(device, count * 4, vk::Memory::device),
        wavefronts(device, wavefront ? count * kWavefrontBytes : 16, vk::Memory::device),
        sums(device, sums ? count * 16 : 16, vk::Memory::device),
        radiance(device, count * 8, vk::Memory::device),
        display(device, count * 4, vk::Memory::device) {}

  std::size_t count;
  bool has_wavefront, has_sums;
  vk::Buffer pixels, keys, wavefronts, sums, radiance, display;
};

double unit_factor(Mode mode) { return mode == Mode::blur ? 60.0 * 180.0 / std::numbers::pi : 1.0; }

double map_value(Mode mode, const glm::vec4& v, const glm::vec4& more) {
  switch (mode) {
    case Mode::power:
      return 0.5 * (v.x + v.z);
    case Mode::astigmatism:
      return std::hypot(v.x - v.z, 2.0F * v.y);
    case Mode::accommodation:
      return v.w;
    default:
      return more.x * unit_factor(mode);
  }
}

// From the 1st to the 99th percentile, outwards to a quarter.
MapRange range_of(Mode mode, const std::vector<glm::vec4>& wavefronts) {
  std::vector<double> values;
  for (std::size_t i = 0; i + 1 < wavefronts.size(); i += 2) {
    if (wavefronts[i + 1].y >= 0.0F) {
      values.push_back(map_value(mode, wavefronts[i], wavefronts[i + 1]));
    }
  }
  if (values.empty()) {
    return {0.0, 1.0};
  }
  const auto percentile = [&](double p) {
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(p * static_cast<double>(values.size() - 1));
    std::ranges::nth_element(values, at);
    return *at;
  };
  const double low = std::floor(4.0 * percentile(0.01)) / 4.0;
  const double high = std::ceil(4.0 * percentile(0.99)) / 4.0;
  return {low, high > low ? high : low + 0.25};
}

}  // namespace

bool is_map(Mode mode) { return mode >= Mode::power; }

struct Renderer::State {
  State(vk::Device& d, const Scene& scene) : device(d), buffers(d, scene) {}

  vk::Device& device;
  SceneBuffers buffers;
  std::map<std::array<std::uint32_t, 4>, vk::Kernel> kernels;  // by stage and specialisation
  std::unique_ptr<FrameBuffers> frame;

  enum Stage : std::uint32_t { chief, edges, dof };

  const vk::Kernel& tracing_kernel(Stage stage, std::uint32_t kinds, bool wavefront, bool keep) {
    const std::array<std::uint32_t, 4> key{stage, kinds, wavefront ? 1U : 0U, keep ? 1U : 0U};
    if (const auto found = kernels.find(key); found != kernels.end()) {
      return found->second;
    }
    const std::array<std::uint32_t, 3> specialization{key[1], key[2], key[3]};
    const std::span<const std::uint32_t> constants =
        stage == chief ? std::span(specialization) : std::span(specialization).first(1);
    const std::span<const std::uint32_t> code = stage == chief   ? std::span<const std::uint32_t>(shaders::chief)
                                                : stage == edges ? std::span<const std::uint32_t>(shaders::edges)
                                                                 : std::span<const std::uint32_t>(shaders::dof);
    const char* name = stage == chief ? "chief" : stage == edges ? "edges" : "dof";
    return kernels
        .emplace(key, vk::Kernel(device, code, scene_and(stage == edges ? 2 : 3), sizeof(gpu::FrameData), constants, name))
        .first->second;
  }

  const vk::Kernel& picture_kernel(bool encode) {
    const std::array<std::uint32_t, 4> key{encode ? 101U : 100U, 0, 0, 0};
    if (const auto found = kernels.find(key); found != kernels.end()) {
      return found->second;
    }
    const std::array blur_bindings{vk::Binding::texel_rgba32ui, vk::Binding::storage_buffer};
    const std::array encode_bindings{vk::Binding::storage_buffer, vk::Binding::storage_buffer,
                                     vk::Binding::storage_buffer};
    return kernels
        .emplace(key, encode ? vk::Kernel(device, shaders::encode, encode_bindings, sizeof(gpu::FrameData), {}, "encode")
                             : vk::Kernel(device, shaders::blur, blur_bindings, sizeof(gpu::FrameData), {}, "blur"))
        .first->second;
  }

  FrameBuffers& frame_buffers(std::size_t count, bool wavefront, bool sums) {
    if (!frame || frame->count != count || (wavefront && !frame->has_wavefront) || (sums && !frame->has_sums)) {
      frame.reset();  // the old one goes first, so that both never stand side by side
      frame = std::make_unique<FrameBuffers>(device, count, wavefront, sums);
    }
    return *frame;
  }

  RenderedFrame render_together(const lenses::LensModel& lenses, const std::vector<ViewSetup>& views,
                                const FrameConfig& config, const Progress& progress);
};

namespace {

// One frame in the making: what its stages share.
struct FrameJob {
  const FrameConfig& config;
  gpu::FrameData data;
  std::uint32_t groups_x, groups_y, groups_z;
  bool wavefront;  // traced at all
  bool keep;       // and written
};

FrameJob make_job(const FrameConfig& config, std::size_t view_count) {
  const bool traced = config.mode != Mode::pinhole || config.keep_wavefront;
  const bool keep = is_map(config.mode) || config.mode == Mode::dof || config.keep_wavefront;
  FrameJob job{config, {}, 0, 0, 0, traced, keep};
  job.data.size = glm::ivec4(config.width, config.height, static_cast<int>(view_count), static_cast<int>(config.mode));
  job.data.sampling = glm::ivec4(0, 0, static_cast<int>(config.seed), config.colour_map);
  // A pinhole picture is the defocused one with nothing left to blur.
  const bool blurs = config.mode == Mode::adof;
  job.data.limits = glm::vec4(blurs ? static_cast<float>(config.threshold_px) : 1e9F, kLargestBlur,
                              std::exp2(static_cast<float>(config.exposure)), 0.0F);
  job.groups_x = (static_cast<std::uint32_t>(config.width) + kTile - 1) / kTile;
  job.groups_y = (static_cast<std::uint32_t>(config.height) + kTile - 1) / kTile;
  job.groups_z = static_cast<std::uint32_t>(view_count);
  return job;
}

void set_range(FrameJob& job, const MapRange& range) {
  job.data.map_range = glm::vec4(static_cast<float>(range.low), static_cast<float>(range.high),
                                 static_cast<float>(unit_factor(job.config.mode)), 0.0F);
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

RenderedView read_view(const FrameBuffers& frame, const FrameConfig& config, std::size_t index) {
  const std::size_t count = static_cast<std::size_t>(config.width) * static_cast<std::size_t>(config.height);
  RenderedView view;
  view.display = {config.width, config.height, std::vector<std::uint8_t>(3 * count)};
  const auto shown = frame.display.read<std::uint32_t>(count, index * count * 4);
  for (std::size_t i = 0; i < count; ++i) {
    view.display.rgb[3 * i] = static_cast<std::uint8_t>(shown[i] & 255U);
    view.display.rgb[3 * i + 1] = static_cast<std::uint8_t>((shown[i] >> 8U) & 255U);
    view.display.rgb[3 * i + 2] = static_cast<std::uint8_t>((shown[i] >> 16U) & 255U);
  }
  if (config.keep_radiance) {
    view.radiance.resize(3 * count);
    const auto packed = frame.radiance.read<glm::uvec2>(count, index * count * 8);
    for (std::size_t i = 0; i < count; ++i) {
      const glm::vec2 rg = glm::unpackHalf2x16(packed[i].x);
      view.radiance[3 * i] = rg.x;
      view.radiance[3 * i + 1] = rg.y;
      view.radiance[3 * i + 2] = glm::unpackHalf2x16(packed[i].y).x;
    }
  }
  if (config.keep_wavefront) {
    const auto wavefronts = frame.wavefronts.read<glm::vec4>(2 * count, index * count * kWavefrontBytes);
    WavefrontPlanes& planes = view.wavefront;
    for (std::size_t i = 0; i < count; ++i) {
      const glm::vec4& v = wavefronts[2 * i];
      const glm::vec4& more = wavefronts[2 * i + 1];
      planes.v_hh.push_back(v.x);
      planes.v_hv.push_back(v.y);
      planes.v_vv.push_back(v.z);
      planes.accommodation.push_back(v.w);
      planes.blur.push_back(more.x);
      planes.depth.push_back(more.y);
    }
  }
  return view;
}

}  // namespace

RenderedFrame Renderer::State::render_together(const lenses::LensModel& lenses, const std::vector<ViewSetup>& views,
                                               const FrameConfig& config, const Progress& progress) {
  FrameJob job = make_job(config, views.size());
  const std::size_t count =
      static_cast<std::size_t>(config.width) * static_cast<std::size_t>(config.height) * views.size();
  FrameBuffers& out = frame_buffers(count, job.keep, config.mode == Mode::dof);
  const vk::Buffer table = filled_buffer(device, lenses::to_float(lenses.table));
  std::vector<gpu::ViewData> view_data;
  std::vector<lenses::f64::LensData> worn;
  for (const ViewSetup& view : views) {
    view_data.push_back(make_view_data(view, lenses));
    worn.push_back(lenses.lens[view.lens]);
  }
  view_data.resize(gpu::kMostViews);  // a uniform buffer has its full size
  const vk::Buffer view_buffer = filled_buffer(device, view_data);
  const std::uint32_t kinds = surface_kinds(worn);
  const auto scene_buffers = [&](std::initializer_list<const vk::Buffer*> more) {
    std::vector<const vk::Buffer*> all{&table,          &buffers.bvh_nodes,   &buffers.bvh_triangles,
                                       &buffers.shading_triangles, &buffers.texels, &view_buffer,
                                       &buffers.environment, &buffers.lights, &buffers.materials, &buffers.textures};
    all.insert(all.end(), more);
    return all;
  };
  RenderedFrame result;

  vk::Commands commands(device);
  commands.dispatch(tracing_kernel(chief, kinds, job.wavefront, job.keep),
                    scene_buffers({&out.pixels, &out.keys, &out.wavefronts}), vk::bytes_of(job.data), job.groups_x,
                    job.groups_y, job.groups_z);
  commands.timestamp("trace");
  if (!is_map(config.mode) && config.mode != Mode::dof) {
    commands.barrier();
    commands.dispatch(tracing_kernel(edges, kinds, false, false), scene_buffers({&out.pixels, &out.keys}),
                      vk::bytes_of(job.data), job.groups_x, job.groups_y, job.groups_z);
    commands.timestamp("edges");
    commands.barrier();
    commands.dispatch(picture_kernel(false), {&out.pixels, &out.radiance}, vk::bytes_of(job.data), job.groups_x,
                      job.groups_y, job.groups_z);
    commands.timestamp("blur");
  }
  const auto encode_into = [&](vk::Commands& target) {
    target.barrier();
    target.dispatch(picture_kernel(true), {&out.radiance, &out.wavefronts, &out.display}, vk::bytes_of(job.data),
                    job.groups_x, job.groups_y, job.groups_z);
    target.timestamp("encode");
  };
  if (config.range) {
    result.range = *config.range;
  }
  set_range(job, result.range);
  const bool encode_later = config.mode == Mode::dof || (is_map(config.mode) && !config.range);
  if (!encode_later) {
    encode_into(commands);
  }
  add_times(result.stages, device.run(commands));

  if (config.mode == Mode::dof) {
    int taken = 0;
    while (taken < config.samples) {
      const int batch = std::min(kSamplesASubmission, config.samples - taken);
      vk::Commands more(device);
      for (int i = 0; i < batch; ++i) {
        job.data.sampling.x = taken + i;
        more.dispatch(tracing_kernel(dof, kinds, true, false),
                      scene_buffers({&out.wavefronts, &out.sums, &out.radiance}), vk::bytes_of(job.data), job.groups_x,
                      job.groups_y, job.groups_z);
        more.barrier();
      }
      more.timestamp("samples");
      add_times(result.stages, device.run(more));
      taken += batch;
      result.error_estimate = rms_standard_error(out.sums.read<glm::vec4>(count), taken);
      if (progress) {
        progress(taken, config.samples);
      }
      // Below 16 samples the estimate itself is too rough to stop on.
      if (config.target_error && taken >= 16 && result.error_estimate <= *config.target_error) {
        break;
      }
    }
    result.samples = taken;
  } else if (encode_later) {
    result.range = range_of(config.mode, out.wavefronts.read<glm::vec4>(2 * count));
    set_range(job, result.range);
  }
  if (encode_later) {
    vk::Commands last(device);
    encode_into(last);
    add_times(result.stages, device.run(last));
  }
  for (std::size_t i = 0; i < views.size(); ++i) {
    result.views.push_back(read_view(out, config, i));
  }
  return result;
}

Renderer::Renderer(vk::Device& device, const Scene& scene) : state_(std::make_unique<State>(device, scene)) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;

RenderedFrame Renderer::render(const lenses::LensModel& lenses, const std::vector<ViewSetup>& views,
                               const FrameConfig& config, const Progress& progress) {
  const std::size_t a_view = static_cast<std::size_t>(config.width) * static_cast<std::size_t>(config.height);
  const FrameJob job = make_job(config, 1);
  const std::size_t bytes_a_view = a_view * (job.keep ? kWavefrontBytes : kPixelBytes);
  if (bytes_a_view * views.size() <= state_->device.limits().max_storage_buffer_bytes) {
    return state_->render_together(lenses, views, config, progress);
  }
  // One after the other, with one range for all.
  RenderedFrame all;
  FrameConfig single = config;
  for (const ViewSetup& view : views) {
    RenderedFrame one = state_->render_together(lenses, {view}, single, progress);
    if (is_map(config.mode) && !single.range) {
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
