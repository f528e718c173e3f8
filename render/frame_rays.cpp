// Chief rays and samples up to what they meet: the stages "rays" and "tile" of a frame.
#include <array>
#include <glm/vec4.hpp>
#include <span>

#include "render/frame_job.hpp"
#include "render/shown_tiles.hpp"

namespace render {
namespace {

constexpr std::uint32_t kGroup = 8;  // local size of the frame's kernels

}  // namespace

// A view's list is worked off before the next view's is made: they share the memory.
void FrameJob::aim(vk::Commands& commands) {
  const Buffers buffers =
      with_scene({&out_.ray_origins, &out_.ray_directions, &out_.list, &out_.wavefronts, &out_.transfers});
  if (cubic_rays_) {
    empty_rough_lists(commands);
  }
  for (data_.view.x = 0; data_.view.x < data_.size.z; ++data_.view.x) {
    empty_list(commands, out_.list);
    commands.barrier();
    if (corners_.rays() > 0 && !variant_.sampled) {
      trace_corners(commands);
    }
    if (cubic_rays_) {
      aim_cubics(commands, buffers);
    } else if (corners_.rays() > 0 && !variant_.sampled) {
      dispatch_view(commands, kernels_.get(Stage::between, variant_),
                    with_scene({&out_.ray_origins, &out_.ray_directions, &out_.list, &out_.corners, &out_.transfers}));
    } else if (double_views_) {
      dispatch_view(commands, kernels_.get(Stage::rays_double, variant_),
                    {&*double_table_, &*double_views_, &out_.ray_origins, &out_.ray_directions, &out_.transfers,
                     &out_.wavefronts});
    } else {
      dispatch_view(commands, kernels_.get(Stage::rays, variant_), buffers);
    }
    commands.barrier();
    if (variant_.surface_kinds != 0) {
      dispatch_list(commands, kernels_.get(Stage::unsettled, variant_), buffers, out_.list);
      commands.barrier();
    }
  }
  commands.timestamp("rays");
}

void FrameJob::trace_corners(vk::Commands& commands) {
  if (trace_corners_) {
    const auto groups = [](int corners) { return (static_cast<std::uint32_t>(corners) + kGroup - 1) / kGroup; };
    const Buffers buffers = with_scene({&out_.corners, &out_.list});
    commands.dispatch(kernels_.get(Stage::corners, variant_), buffers, vk::bytes_of(data_), groups(corners_.count.x),
                      groups(corners_.count.y));
    commands.barrier();
    dispatch_list(commands, kernels_.get(Stage::unsettled_corners, variant_), buffers, out_.list);
    commands.barrier();
    empty_list(commands, out_.list);
    commands.barrier();
  }
}

void FrameJob::empty_rough_lists(vk::Commands& commands) {
  std::array<glm::uvec4, gpu::kMostViews> none;
  none.fill({0, 0, 1, 0});
  commands.update(out_.rough_counts, std::as_bytes(std::span(none)));
  commands.copy(*no_tiles_, out_.rough_tiles, no_tiles_->bytes());
}

// Smooth tiles are left to the kernels that take up their rays.
void FrameJob::aim_cubics(vk::Commands& commands, const Buffers& buffers) {
  const auto groups = [](int pixels) {
    return (static_cast<std::uint32_t>(pixels) + kGroup * kShownTile - 1) / (kGroup * kShownTile);
  };
  commands.dispatch(kernels_.get(Stage::find_rough, variant_),
                    {&out_.corners, &out_.smooth_tiles, &out_.rough_tiles, &out_.rough_counts, &out_.shown_tiles},
                    vk::bytes_of(data_), groups(data_.size.x), groups(data_.size.y));
  commands.barrier();
  dispatch_rough_view(commands, Stage::rays, buffers);
}

void FrameJob::find_hits(vk::Commands& commands) {
  empty_list(commands, out_.list);
  commands.barrier();
  if (accelerated_ != nullptr) {
    dispatch(commands, kernels_.get(Stage::ray_query, variant_),
             with_scene({&out_.ray_origins, &out_.ray_directions, &out_.hits, &out_.list, accelerated_}));
  } else {
    const Buffers buffers{&out_.ray_origins,     &out_.ray_directions, &scene_.wide_nodes,
                          &scene_.bvh_triangles, &out_.hits,           &out_.list};
    if (cubic_rays_) {
      dispatch(commands, kernels_.get(Stage::tile_cubic, variant_),
               {&out_.corners, &out_.smooth_tiles, &scene_.wide_nodes, &scene_.bvh_triangles, &out_.hits, &out_.list,
                &views_, &out_.ray_origins, &out_.ray_directions});
      commands.barrier();
      dispatch_rough(commands, Stage::tile, buffers);
    } else {
      dispatch(commands, kernels_.get(Stage::tile, variant_), buffers);
    }
  }
  commands.barrier();
  dispatch_list(commands, kernels_.get(Stage::left_out, variant_),
                with_scene({&out_.ray_origins, &out_.ray_directions, &out_.hits, &out_.list}), out_.list);
  commands.timestamp(accelerated_ != nullptr ? "ray_query" : "tile");
  commands.barrier();
}

}  // namespace render
