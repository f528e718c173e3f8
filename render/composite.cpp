#include "render/composite.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numbers>
#include <utility>

#include "shaders/composite.hpp"

namespace render {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kFadeShare = 0.25;  // of the fovea's angle
constexpr double kLeastFade_deg = 1.0;
// What a blur may reach across the end of the fovea's layer: the half pupil of 1.75 mm times 10 D is a degree.
constexpr double kBlurReach_deg = 1.0;
constexpr double kWorthwhile = 0.9;  // of the picture's pixels: more in both layers are no saving

glm::dvec3 gaze_in_picture(const ViewSetup& view) {
  return glm::inverse(glm::normalize(view.view.head_from_view.orientation)) * glm::normalize(view.view.gaze);
}

// Tangents between which a cone around the gaze lies, along one axis of the picture: where planes through the pupil
// and the other axis touch it. along: the gaze's component on this axis, ahead: on the picture's axis. All of the axis
// where the cone reaches the pupil's own plane.
std::pair<double, double> cone_tangents(double along, double ahead, double sine) {
  constexpr double kAll = 1e9;
  const double below = ahead * ahead - sine * sine;
  if (ahead <= 0.0 || below <= 1e-9) {
    return {-kAll, kAll};
  }
  const double root = sine * std::sqrt(std::max(along * along + below, 0.0));
  return {(along * ahead - root) / below, (along * ahead + root) / below};
}

struct PixelRect {
  glm::ivec2 low{0}, high{0};
};

// The pixels within the cone, none where it does not meet the picture.
PixelRect cone_pixels(const ViewSetup& view, const glm::ivec2& size, double angle) {
  const glm::dvec3 gaze = gaze_in_picture(view);
  const tracking::FieldOfView& fov = view.view.fov;
  const double sine = std::sin(std::min(angle, 0.5 * std::numbers::pi));
  const auto [left, right] = cone_tangents(gaze.x, -gaze.z, sine);
  const auto [down, up] = cone_tangents(gaze.y, -gaze.z, sine);
  const auto pixel = [](double share, int pixels) { return static_cast<int>(std::clamp(share, 0.0, 1.0) * pixels); };
  const double width = fov.tan_left + fov.tan_right, height = fov.tan_down + fov.tan_up;
  const double one_x = 1.0 / size.x, one_y = 1.0 / size.y;  // upwards to whole pixels
  PixelRect rect;
  rect.low = {pixel((left + fov.tan_left) / width, size.x), pixel((fov.tan_up - up) / height, size.y)};
  rect.high = {pixel((right + fov.tan_left) / width + one_x, size.x),
               pixel((fov.tan_up - down) / height + one_y, size.y)};
  if (rect.high.x <= rect.low.x || rect.high.y <= rect.low.y || gaze.z >= 0.0) {
    return {};
  }
  return rect;
}

// The same view, but for a part of its field.
ViewSetup part_of(ViewSetup view, const glm::ivec2& size, const glm::ivec2& origin, const glm::ivec2& extent) {
  const tracking::FieldOfView whole = view.view.fov;
  const double across = (whole.tan_left + whole.tan_right) / size.x, down = (whole.tan_down + whole.tan_up) / size.y;
  view.view.fov.tan_left = whole.tan_left - across * origin.x;
  view.view.fov.tan_right = across * (origin.x + extent.x) - whole.tan_left;
  view.view.fov.tan_up = whole.tan_up - down * origin.y;
  view.view.fov.tan_down = down * (origin.y + extent.y) - whole.tan_up;
  return view;
}

FrameConfig layer_config(const FrameConfig& config, const glm::ivec2& extent, double resolution) {
  FrameConfig layer = config;
  layer.width = std::max(1, static_cast<int>(std::lround(extent.x * resolution)));
  layer.height = std::max(1, static_cast<int>(std::lround(extent.y * resolution)));
  layer.threshold_px = config.threshold_px * layer.width / extent.x;  // a threshold counts shown pixels
  layer.accuracy.resolution = 1.0;
  layer.accuracy.foveation = {};
  layer.keep_radiance = true;  // what is put together
  return layer;
}

// A cone around the gaze that holds all of the fovea that is shown, and as much more as a blur reaches.
PixelRect fovea_pixels(const FrameConfig& config, const ViewSetup& view) {
  const double shown = std::acos(fovea_fade(config.accuracy.foveation).cos_outer);
  return cone_pixels(view, {config.width, config.height}, shown + kBlurReach_deg * kDegree);
}

// The layer's part of each view, as the gaze is now.
void aim_fovea(CompositeLayer& layer, const FrameConfig& config, const std::vector<ViewSetup>& views) {
  const glm::ivec2 size(config.width, config.height);
  layer.origin.clear();
  layer.views.clear();
  for (const ViewSetup& view : views) {
    const PixelRect rect = fovea_pixels(config, view);
    const glm::ivec2 low = (rect.low + rect.high - layer.extent) / 2;
    layer.origin.push_back(glm::clamp(low, glm::ivec2(0), size - layer.extent));
    layer.views.push_back(part_of(view, size, layer.origin.back(), layer.extent));
  }
}

// Large enough for the largest of the views' cones, times `room`.
std::optional<CompositeLayer> fovea_layer(const FrameConfig& config, const std::vector<ViewSetup>& views, double room) {
  CompositeLayer layer;
  for (const ViewSetup& view : views) {
    const PixelRect rect = fovea_pixels(config, view);
    layer.extent = glm::max(layer.extent, rect.high - rect.low);
  }
  if (layer.extent.x == 0 || layer.extent.y == 0) {
    return std::nullopt;
  }
  layer.extent =
      glm::min(glm::ivec2(glm::ceil(room * glm::dvec2(layer.extent))), glm::ivec2(config.width, config.height));
  layer.config = layer_config(config, layer.extent, config.accuracy.resolution);
  aim_fovea(layer, config, views);
  return layer;
}

CompositePlan plan_with(const FrameConfig& config, const std::vector<ViewSetup>& views, double room) {
  const glm::ivec2 size(config.width, config.height);
  const Foveation& foveation = config.accuracy.foveation;
  CompositePlan plan;
  double resolution = config.accuracy.resolution;
  if (foveation.rate > 1 && foveation.fovea_deg > 0.0) {
    plan.fovea = fovea_layer(config, views, room);
    const double fovea =
        plan.fovea ? double(plan.fovea->extent.x) * plan.fovea->extent.y / (double(size.x) * size.y) : 0.0;
    const double rate = foveation.rate;
    if (fovea + 1.0 / (rate * rate) < kWorthwhile) {
      resolution /= rate;
    } else {
      plan.fovea.reset();
    }
  }
  plan.whole = {layer_config(config, size, resolution), views, std::vector<glm::ivec2>(views.size(), {0, 0}), size};
  return plan;
}

gpu::CompositeData data_of(const CompositePlan& plan, const FrameConfig& config, const ViewSetup& view,
                           std::size_t index) {
  const tracking::FieldOfView& fov = view.view.fov;
  const double pixels_per_radian = config.width / (fov.tan_left + fov.tan_right);
  const int reach = static_cast<int>(kBlurReach_deg * kDegree * pixels_per_radian);
  gpu::CompositeData data{};
  data.shown = glm::ivec4(config.width, config.height, config.keep_radiance ? 1 : 0, reach);
  data.whole = glm::ivec4(plan.whole.config.width, plan.whole.config.height, 0, 0);
  if (plan.fovea) {
    data.fovea = glm::ivec4(plan.fovea->config.width, plan.fovea->config.height, plan.fovea->origin[index]);
    data.extent = glm::ivec4(plan.fovea->extent, 0, 0);
  }
  data.tangents = glm::vec4(fov.tan_left, fov.tan_right, fov.tan_down, fov.tan_up);
  data.gaze = glm::vec4(glm::vec3(gaze_in_picture(view)), std::exp2(static_cast<float>(config.exposure)));
  const FoveaFade fade = fovea_fade(config.accuracy.foveation);
  data.limits = glm::vec4(fade.cos_inner, fade.cos_outer, 0.0, 0.0);
  return data;
}

// The nearest texel of a layer for each shown pixel of a rectangle.
void put_nearest(const WavefrontPlanes& from, const glm::ivec2& traced, WavefrontPlanes& to, int width,
                 const glm::ivec2& origin, const glm::ivec2& extent, const auto& wanted) {
  for (int y = 0; y < extent.y; ++y) {
    for (int x = 0; x < extent.x; ++x) {
      const glm::ivec2 p = origin + glm::ivec2(x, y);
      if (!wanted(p)) {
        continue;
      }
      const int u = (2 * x + 1) * traced.x / (2 * extent.x), v = (2 * y + 1) * traced.y / (2 * extent.y);
      const std::size_t source =
          static_cast<std::size_t>(v) * static_cast<std::size_t>(traced.x) + static_cast<std::size_t>(u);
      const std::size_t target =
          static_cast<std::size_t>(p.y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(p.x);
      for (const auto plane : {&WavefrontPlanes::v_hh, &WavefrontPlanes::v_hv, &WavefrontPlanes::v_vv,
                               &WavefrontPlanes::accommodation, &WavefrontPlanes::blur, &WavefrontPlanes::depth}) {
        (to.*plane)[target] = (from.*plane)[source];
      }
    }
  }
}

}  // namespace

bool is_composed(const FrameConfig& config) {
  const Accuracy& accuracy = config.accuracy;
  const bool foveated = accuracy.foveation.rate > 1 && accuracy.foveation.fovea_deg > 0.0;
  return !is_map(config.mode) && (accuracy.resolution != 1.0 || foveated);
}

FoveaFade fovea_fade(const Foveation& foveation) {
  const double fade = std::max(kFadeShare * foveation.fovea_deg, kLeastFade_deg);
  const double inner = std::min(foveation.fovea_deg, 180.0), outer = std::min(foveation.fovea_deg + fade, 180.0);
  return {std::cos(inner * kDegree), std::cos(outer * kDegree)};
}

CompositePlan plan_composite(const FrameConfig& config, const std::vector<ViewSetup>& views) {
  return plan_with(config, views, 1.0);
}

CompositePlan plan_moving_composite(const FrameConfig& config, const std::vector<ViewSetup>& views) {
  constexpr double kRoom = 1.25;  // a cone 25 degrees aside is as much wider on the picture's plane
  std::vector<ViewSetup> ahead = views;
  for (ViewSetup& view : ahead) {
    view.view.gaze = view.view.head_from_view.orientation * glm::dvec3(0.0, 0.0, -1.0);
  }
  CompositePlan plan = plan_with(config, ahead, kRoom);
  aim_composite(plan, config, views);
  return plan;
}

void aim_composite(CompositePlan& plan, const FrameConfig& config, const std::vector<ViewSetup>& views) {
  plan.whole.views = views;
  if (plan.fovea) {
    aim_fovea(*plan.fovea, config, views);
  }
}

std::vector<gpu::CompositeData> composite_data(const CompositePlan& plan, const FrameConfig& config,
                                               const std::vector<ViewSetup>& views) {
  std::vector<gpu::CompositeData> data;
  for (std::size_t i = 0; i < views.size(); ++i) {
    data.push_back(data_of(plan, config, views[i], i));
  }
  data.resize(gpu::kMostViews);  // a uniform buffer has its full size
  return data;
}

void Compositor::record(vk::Commands& commands, const FrameConfig& config, std::size_t views, const vk::Buffer& data,
                        const DrawnLayers& layers, const vk::Buffer& radiance, const vk::Buffer& display) {
  constexpr std::array kBindings{vk::Binding::texel_rg32ui, vk::Binding::texel_rg32ui, vk::Binding::storage_buffer,
                                 vk::Binding::storage_buffer, vk::Binding::uniform_buffer};
  constexpr std::uint32_t kGroup = 8;
  if (!kernel_) {
    kernel_.emplace(device_, shaders::composite, kBindings, sizeof(std::int32_t), std::span<const std::uint32_t>{},
                    "composite");
  }
  const vk::Buffer& fovea = layers.fovea != nullptr ? layers.fovea->radiance : layers.whole.radiance;
  commands.barrier();
  for (std::int32_t view = 0; view < static_cast<std::int32_t>(views); ++view) {
    commands.dispatch(*kernel_, {&layers.whole.radiance, &fovea, &radiance, &display, &data}, vk::bytes_of(view),
                      (static_cast<std::uint32_t>(config.width) + kGroup - 1) / kGroup,
                      (static_cast<std::uint32_t>(config.height) + kGroup - 1) / kGroup);
  }
  commands.timestamp("composite");
}

WavefrontPlanes composed_wavefront(const CompositePlan& plan, const FrameConfig& config,
                                   const std::vector<ViewSetup>& views, const DrawnLayers& layers, std::size_t index) {
  const std::size_t pixels = static_cast<std::size_t>(config.width) * static_cast<std::size_t>(config.height);
  WavefrontPlanes planes;
  for (auto* plane : {&planes.v_hh, &planes.v_hv, &planes.v_vv, &planes.accommodation, &planes.blur, &planes.depth}) {
    plane->resize(pixels);
  }
  const auto traced = [](const CompositeLayer& layer) { return glm::ivec2(layer.config.width, layer.config.height); };
  put_nearest(read_wavefronts(layers.whole.wavefronts, plan.whole.config, index), traced(plan.whole), planes,
              config.width, {0, 0}, plan.whole.extent, [](const glm::ivec2&) { return true; });
  if (plan.fovea) {
    const tracking::FieldOfView& fov = views[index].view.fov;
    const glm::dvec3 gaze = gaze_in_picture(views[index]);
    const FoveaFade fade = fovea_fade(config.accuracy.foveation);
    const auto mostly_fovea = [&](const glm::ivec2& p) {
      const glm::dvec3 direction(glm::mix(-fov.tan_left, fov.tan_right, (p.x + 0.5) / config.width),
                                 glm::mix(fov.tan_up, -fov.tan_down, (p.y + 0.5) / config.height), -1.0);
      return glm::dot(glm::normalize(direction), gaze) >= 0.5 * (fade.cos_inner + fade.cos_outer);
    };
    put_nearest(read_wavefronts(layers.fovea->wavefronts, plan.fovea->config, index), traced(*plan.fovea), planes,
                config.width, plan.fovea->origin[index], plan.fovea->extent, mostly_fovea);
  }
  return planes;
}

}  // namespace render
