#include "render/frame_job.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <thread>

#include "render/frame_blur.hpp"
#include "render/gpu_tracer.hpp"
#include "render/lens_forms/double_view.hpp"
#include "render/lens_forms/tile_cubics.hpp"
#include "render/map_range.hpp"
#include "render/sample_point.hpp"
#include "render/shown_tiles.hpp"

namespace render {
namespace {

// Numbers that cross to the shaders.
static_assert(gpu::kModePinhole == static_cast<int>(Mode::pinhole) && gpu::kModeAdof == static_cast<int>(Mode::adof) &&
              gpu::kModeDof == static_cast<int>(Mode::dof) && gpu::kModePower == static_cast<int>(Mode::power) &&
              gpu::kModeAstigmatism == static_cast<int>(Mode::astigmatism) &&
              gpu::kModeAccommodation == static_cast<int>(Mode::accommodation) &&
              gpu::kModeBlur == static_cast<int>(Mode::blur));

static_assert(sizeof(gpu::ViewData) == gpu::kViewTexels * sizeof(glm::vec4));  // view_words.glsl

constexpr std::uint32_t kGroup = 8;  // local size of the frame's kernels
// What a bare picture keeps of a scene: where faces are, and their base colour.
constexpr auto kBareFeatures =
    static_cast<std::uint32_t>(gpu::kFeatureCull | gpu::kFeatureMask | gpu::kFeatureTexture | gpu::kFeatureColours |
                               gpu::kFeatureSecondUv | gpu::kFeatureTransform | gpu::kFeatureUnlit);
constexpr float kLargestBlur = 512.0F;  // px; beyond it nothing is left to see
constexpr float kNoBlurDrawn = 1e9F;    // px, as a threshold

}  // namespace

std::vector<gpu::ViewData> view_data(const lenses::LensModel& lenses, const std::vector<ViewSetup>& views) {
  std::vector<gpu::ViewData> data;
  for (const ViewSetup& view : views) {
    data.push_back(make_view_data(view, lenses));
  }
  data.resize(gpu::kMostViews);  // as many as a live frame hands over
  return data;
}

bool encodes_later(const FrameConfig& config) {
  return config.mode == Mode::dof || (is_map(config.mode) && !config.range);
}

bool keeps_transfer(const LensAccuracy& lens) {
  return lens.form != LensForm::exact || lens.in_double || lens.spacing > 1;
}

FrameBuffers::Size buffers_for(const FrameConfig& config, const std::vector<ViewSetup>& views, Traversal traversal) {
  const std::size_t pixels = static_cast<std::size_t>(config.width) * static_cast<std::size_t>(config.height);
  const bool transfers = keeps_transfer(config.accuracy.lens);
  const bool cubic = may_be_cubic(config, views, traversal);
  const CornerGrid corners = cubic ? tile_corner_grid(config.width, config.height)
                                   : corner_grid(config.accuracy.lens, config.width, config.height);
  return {.pixels = pixels * views.size(),
          .wavefront = keeps_wavefront(config, views),
          .sums = config.mode == Mode::dof,
          .hits = traversal != Traversal::per_ray || config.mode == Mode::dof || transfers,
          .transfers = transfers,
          .corner_rays = corners.rays() * views.size(),
          .cubic_tiles = cubic ? listed_tile_words(config.width, config.height) * views.size() : 0,
          .blur_tiles = config.mode == Mode::adof ? blur_tiles(config.width, config.height) : 0};
}

bool keeps_wavefront(const FrameConfig& config, const std::vector<ViewSetup>& views) {
  const bool own_focus = std::ranges::any_of(views, [](const ViewSetup& view) { return !view.accommodation; });
  return is_map(config.mode) || (config.mode == Mode::dof && own_focus) || config.keep_wavefront;
}

FrameJob::FrameJob(vk::Device& device, const SceneBuffers& scene, KernelSet& kernels, FrameBuffers& out,
                   const lenses::LensModel& lenses, const std::vector<ViewSetup>& views, const FrameConfig& config,
                   Traversal traversal)
    : scene_(scene),
      kernels_(kernels),
      out_(out),
      config_(config),
      traversal_(traversal),
      table_(filled_buffer(device, lenses::to_float(lenses.table))),
      views_(filled_buffer(device, view_data(lenses, views))),
      corners_(corner_grid(config.accuracy.lens, config.width, config.height)) {
  config.accuracy.lens.validate();
  std::vector<lenses::f64::LensData> worn;
  for (const ViewSetup& view : views) {
    worn.push_back(lenses.lens[view.lens]);
  }
  variant_.surface_kinds = surface_kinds(worn);
  variant_.view_traits = view_traits(views, lenses);
  half_pupil_px_ = half_pupils_px(views, config.width);
  variant_.scene_features = scene.features;
  variant_.wavefront = config.mode != Mode::pinhole || config.keep_wavefront;
  variant_.keep_wavefront = keeps_wavefront(config, views);
  variant_.bare = config.bare;
  variant_.listed_tiles = out.size.listed_tiles > 0;
  variant_.newton_steps = static_cast<std::uint32_t>(config.accuracy.lens.iterations);
  variant_.keep_transfer = variant_.surface_kinds != 0 && keeps_transfer(config.accuracy.lens);
  if (variant_.surface_kinds == 0) {
    corners_ = {};  // nothing to interpolate
  }
  if (may_be_cubic(config, views, traversal) && can_be_cubic(device.limits(), variant_.surface_kinds)) {
    corners_ = tile_corner_grid(config.width, config.height);
    cubic_rays_ = true;
    no_tiles_ = filled_buffer(device, std::vector<std::uint32_t>(out.size.cubic_tiles, kNoTile));
  }
  if (config.accuracy.lens.in_double && variant_.surface_kinds != 0) {
    if (!device.limits().has_float64) {
      throw vk::DeviceError(device.name() +
                            " has no double precision (shaderFloat64): lens-double cannot be traced there");
    }
    double_table_ = filled_buffer(device, lenses.table);
    double_views_ = filled_buffer(device, double_views(views, lenses));
  }
  if (corners_.rays() > 0) {
    std::vector<std::byte> key;
    if (config.accuracy.lens.form == LensForm::field) {
      key = corner_key(config.accuracy.lens, corners_, view_data(lenses, views), lenses::to_float(lenses.table));
    }
    trace_corners_ = key.empty() || key != out_.corners_of;
    out_.corners_of = std::move(key);
    data_.corners = glm::vec4(corners_.spacing, corners_.count);
  }
  variant_.hits_known = traversal != Traversal::per_ray;
  if (config.bare) {
    variant_.scene_features &= kBareFeatures;
  }
  if (traversal == Traversal::ray_query) {
    accelerated_ = &scene.acceleration(device).top;
  }
  data_.view.z = device.limits().on_processor ? static_cast<int>(std::max(1U, std::thread::hardware_concurrency())) : 1;
  data_.size = glm::ivec4(config.width, config.height, static_cast<int>(views.size()), static_cast<int>(config.mode));
  data_.sampling = glm::ivec4(0, static_cast<int>(listed_tile_words(config.width, config.height)),
                              static_cast<int>(config.seed), config.colour_map);
  // A pinhole picture is the defocused one with nothing left to blur.
  const float threshold = config.mode == Mode::adof ? static_cast<float>(config.threshold_px) : kNoBlurDrawn;
  data_.limits = glm::vec4(threshold, kLargestBlur, std::exp2(static_cast<float>(config.exposure)), 0.0F);
}

void FrameJob::set_range(const MapRange& range) {
  data_.map_range = glm::vec4(static_cast<float>(range.low), static_cast<float>(range.high),
                              static_cast<float>(map_unit_factor(config_.mode)), 0.0F);
}

void FrameJob::record_views(vk::Commands& commands, const vk::Buffer& from) {
  commands.copy(from, views_, views_.bytes());
  commands.barrier();
}

void FrameJob::record_double_views(vk::Commands& commands, const vk::Buffer& from) {
  if (double_views_) {
    commands.copy(from, *double_views_, double_views_->bytes());
    commands.barrier();
  }
}

void FrameJob::record_picture(vk::Commands& commands, bool shown) {
  if (config_.mode != Mode::dof || variant_.keep_wavefront) {
    record_trace(commands);
  }
  if (config_.mode == Mode::adof || config_.mode == Mode::pinhole) {
    if (!config_.bare) {
      record_edges(commands);
    }
    record_blur(commands);
    if (!config_.keep_radiance || !shown) {
      return;  // the blur has encoded too, or nobody asks for it
    }
  }
  if (!encodes_later(config_)) {
    record_encode(commands);
  }
}

void FrameJob::record_trace(vk::Commands& commands) {
  variant_.sampled = false;
  if (traversal_ == Traversal::per_ray && !variant_.keep_transfer) {
    trace_with(commands, Stage::chief, {&out_.pixels, &out_.keys, &out_.wavefronts});
  } else {
    aim(commands);
    if (variant_.hits_known) {
      find_hits(commands);
    }
    const Buffers to_found{&out_.pixels,      &out_.keys,           &out_.wavefronts, &out_.hits,
                           &out_.ray_origins, &out_.ray_directions, &out_.transfers};
    if (cubic_rays_) {
      trace_with(commands, Stage::found_cubic,
                 {&out_.pixels, &out_.keys, &out_.wavefronts, &out_.hits, &out_.corners, &out_.smooth_tiles});
      dispatch_rough(commands, Stage::found, with_scene(to_found));
    } else {
      trace_with(commands, Stage::found, to_found);
    }
  }
  commands.timestamp("trace");
}

void FrameJob::record_edges(vk::Commands& commands) {
  for (data_.view.x = 0; data_.view.x < data_.size.z; ++data_.view.x) {
    commands.barrier();
    empty_list(commands, out_.list);
    empty_list(commands, out_.doubtful);
    dispatch_blocks(commands, kernels_.get(Stage::beam_blocks, variant_),
                    with_scene({&out_.blocks, &out_.pixels, &out_.keys}));
    commands.barrier();
    dispatch_view(commands, kernels_.get(Stage::find_edges, variant_),
                  {&out_.pixels, &out_.keys, &out_.blocks, &out_.list, &out_.doubtful});
    commands.barrier();
    dispatch_list(commands, kernels_.get(Stage::beams, variant_),
                  with_scene({&out_.doubtful, &out_.list, &out_.keys, &out_.pixels}), out_.doubtful);
    commands.barrier();
    empty_list(commands, out_.doubtful);
    commands.barrier();
    const vk::Kernel& edges = kernels_.get(Stage::edges, variant_);
    dispatch_list(commands, edges, with_scene({&out_.pixels, &out_.list, &out_.doubtful, &out_.keys}), out_.list);
    commands.barrier();
    data_.view.y = 1;
    dispatch_list(commands, edges, with_scene({&out_.pixels, &out_.doubtful, &out_.list, &out_.keys}), out_.doubtful);
    data_.view.y = 0;
  }
  commands.timestamp("edges");
}

void FrameJob::record_encode(vk::Commands& commands) {
  commands.barrier();
  dispatch(commands, kernels_.get(is_map(config_.mode) ? Stage::colour : Stage::encode, variant_),
           {is_map(config_.mode) ? &out_.wavefronts : &out_.radiance, &out_.display});
  commands.timestamp("encode");
}

void FrameJob::record_sample(vk::Commands& commands, int index) {
  variant_.sampled = true;
  data_.sampling.x = index;
  data_.sample_point = sample_point(static_cast<std::uint32_t>(index), config_.seed);
  aim(commands);
  if (variant_.hits_known) {
    find_hits(commands);
  }
  trace_with(commands, Stage::samples,
             {&out_.sums, &out_.radiance, &out_.hits, &out_.ray_origins, &out_.ray_directions});
  commands.timestamp("samples");
  commands.barrier();
}

// The view of data_.view, an invocation for each square of `side` pixels.
void FrameJob::dispatch_squares(vk::Commands& commands, const vk::Kernel& kernel, const Buffers& buffers, int side) {
  const auto groups = [&](int pixels) {
    const std::uint32_t pixels_a_group = kGroup * static_cast<std::uint32_t>(side);
    return (static_cast<std::uint32_t>(pixels) + pixels_a_group - 1) / pixels_a_group;
  };
  commands.dispatch(kernel, buffers, vk::bytes_of(data_), groups(data_.size.x), groups(data_.size.y));
}

// A kernel of those that go_by_tiles().
void FrameJob::dispatch_view(vk::Commands& commands, const vk::Kernel& kernel, const Buffers& buffers) {
  dispatch_tiles(commands, kernel, buffers, 1, 0);
}

// An invocation for each of the squares that share a beam.
void FrameJob::dispatch_blocks(vk::Commands& commands, const vk::Kernel& kernel, const Buffers& buffers) {
  dispatch_tiles(commands, kernel, buffers, gpu::kBeamBlock, kBlockCountsAt);
}

void FrameJob::dispatch_tiles(vk::Commands& commands, const vk::Kernel& kernel, Buffers buffers, int side,
                              std::size_t counts_at) {
  buffers.push_back(&out_.shown_tiles);
  if (variant_.listed_tiles) {
    commands.dispatch_indirect(kernel, buffers, vk::bytes_of(data_), out_.shown_counts,
                               static_cast<std::size_t>(data_.view.x) * kShownCountsBytes + counts_at);
  } else {
    dispatch_squares(commands, kernel, buffers, side);
  }
}

void FrameJob::dispatch(vk::Commands& commands, const vk::Kernel& kernel, const Buffers& buffers) {
  for (data_.view.x = 0; data_.view.x < data_.size.z; ++data_.view.x) {
    dispatch_view(commands, kernel, buffers);
  }
}

// Those of the view's tiles whose rays are no cubics, one ray a pixel.
void FrameJob::dispatch_rough_view(vk::Commands& commands, Stage stage, Buffers buffers) {
  TraceVariant rough = variant_;
  rough.listed_tiles = true;
  buffers.push_back(&out_.rough_tiles);
  commands.dispatch_indirect(kernels_.get(stage, rough), buffers, vk::bytes_of(data_), out_.rough_counts,
                             static_cast<std::size_t>(data_.view.x) * kRoughCountsBytes);
}

void FrameJob::dispatch_rough(vk::Commands& commands, Stage stage, const Buffers& buffers) {
  for (data_.view.x = 0; data_.view.x < data_.size.z; ++data_.view.x) {
    dispatch_rough_view(commands, stage, buffers);
  }
}

void FrameJob::dispatch_list(vk::Commands& commands, const vk::Kernel& kernel, const Buffers& buffers,
                             const vk::Buffer& list) {
  commands.dispatch_indirect(kernel, buffers, vk::bytes_of(data_), list);
}

void FrameJob::empty_list(vk::Commands& commands, vk::Buffer& list) {
  constexpr std::array<std::uint32_t, gpu::kListFirstAt> kEmpty{0, 1, 1, 0};
  commands.update(list, std::as_bytes(std::span(kEmpty)));
}

void FrameJob::trace_with(vk::Commands& commands, Stage stage, const Buffers& own) {
  dispatch(commands, kernels_.get(stage, variant_), with_scene(own));
}

FrameJob::Buffers FrameJob::with_scene(const Buffers& own) const {
  Buffers all{&table_, &scene_.bvh_nodes,   &scene_.bvh_triangles, &scene_.shading_triangles, &scene_.texels,
              &views_, &scene_.environment, &scene_.lights,        &scene_.materials,         &scene_.textures};
  all.insert(all.end(), own.begin(), own.end());
  return all;
}

}  // namespace render
