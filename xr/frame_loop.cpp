#include "xr/frame_loop.hpp"

#include <algorithm>
#include <iterator>
#include <thread>

#include "xr/convert.hpp"

namespace xr {
namespace {

using tracking::Side;

constexpr auto kStereo = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
constexpr std::chrono::milliseconds kIdlePoll{4};  // OpenXR has no call that waits for an event

std::array<XrViewConfigurationView, 2> view_configurations(const Instance& instance) {
  std::array<XrViewConfigurationView, 2> views{};
  views.fill({XR_TYPE_VIEW_CONFIGURATION_VIEW, nullptr, 0, 0, 0, 0, 0, 0});
  std::uint32_t count = 2;
  check(xrEnumerateViewConfigurationViews(instance.handle(), instance.system(), kStereo, 2, &count, views.data()),
        "xrEnumerateViewConfigurationViews");
  return views;
}

XrEnvironmentBlendMode preferred_blend_mode(const Instance& instance) {
  std::uint32_t count = 0;
  check(xrEnumerateEnvironmentBlendModes(instance.handle(), instance.system(), kStereo, 0, &count, nullptr),
        "xrEnumerateEnvironmentBlendModes");
  std::vector<XrEnvironmentBlendMode> modes(count);
  check(xrEnumerateEnvironmentBlendModes(instance.handle(), instance.system(), kStereo, count, &count, modes.data()),
        "xrEnumerateEnvironmentBlendModes");
  const bool opaque = std::ranges::find(modes, XR_ENVIRONMENT_BLEND_MODE_OPAQUE) != modes.end();
  return opaque || modes.empty() ? XR_ENVIRONMENT_BLEND_MODE_OPAQUE : modes.front();
}

}  // namespace

std::array<std::array<int, 2>, 2> recommended_sizes(const Instance& instance) {
  const auto views = view_configurations(instance);
  std::array<std::array<int, 2>, 2> sizes{};
  for (const Side side : {Side::right, Side::left}) {
    const XrViewConfigurationView& view = views[view_index(side)];
    sizes[static_cast<std::size_t>(side)] = {static_cast<int>(view.recommendedImageRectWidth),
                                             static_cast<int>(view.recommendedImageRectHeight)};
  }
  return sizes;
}

FrameLoop::FrameLoop(Session& session, const FrameLoopConfig& config)
    : session_(session),
      space_(session, choose_space(session, config.space)),
      view_space_(session, XR_REFERENCE_SPACE_TYPE_VIEW),
      recentring_(session, space_.type()),
      blend_mode_(preferred_blend_mode(session.instance())) {
  const auto recommended = recommended_sizes(session.instance());
  const auto views = view_configurations(session.instance());
  for (const Side side : {Side::right, Side::left}) {
    const auto i = static_cast<std::size_t>(side);
    const auto size = config.size.value_or(recommended[i]);
    const XrViewConfigurationView& limits = views[view_index(side)];
    if (size[0] > static_cast<int>(limits.maxImageRectWidth) || size[1] > static_cast<int>(limits.maxImageRectHeight)) {
      throw Error("openxr: images of " + std::to_string(size[0]) + "x" + std::to_string(size[1]) +
                  " are more than the runtime takes, " + std::to_string(limits.maxImageRectWidth) + "x" +
                  std::to_string(limits.maxImageRectHeight));
    }
    swapchains_[i] = std::make_unique<Swapchain>(
        session, SwapchainConfig{.width = size[0], .height = size[1], .readable = config.readable});
  }
}

void FrameLoop::poll() {
  while (const auto event = session_.instance().poll()) {
    session_.handle(*event);
    recentring_.handle(*event);
    for (const auto& listener : listeners_) {
      listener(*event);
    }
  }
}

std::optional<Frame> FrameLoop::next() {
  for (poll(); !session_.is_over() && !session_.is_running(); poll()) {
    if (idle_ && !idle_()) {
      return std::nullopt;
    }
    std::this_thread::sleep_for(kIdlePoll);
  }
  if (session_.is_over()) {
    return std::nullopt;
  }
  XrFrameState state{};
  state.type = XR_TYPE_FRAME_STATE;
  check(xrWaitFrame(session_.handle(), nullptr, &state), "xrWaitFrame");
  const auto woken = std::chrono::steady_clock::now();
  check(xrBeginFrame(session_.handle(), nullptr), "xrBeginFrame");
  Frame frame = last_;
  frame.woken = woken;
  frame.display_time = state.predictedDisplayTime;
  frame.period = state.predictedDisplayPeriod;
  frame.should_render = state.shouldRender != XR_FALSE;
  frame.new_from_old.reset();
  if (frame.display_time > 0) {
    frame.new_from_old = recentring_.moved_by(frame.display_time);
    locate(frame);
  } else {
    frame.should_render = false;
  }
  last_ = frame;
  return frame;
}

// Without a valid pose the frame keeps the last one and asks for no picture.
void FrameLoop::locate(Frame& frame) {
  constexpr XrViewStateFlags kNeeded = XR_VIEW_STATE_ORIENTATION_VALID_BIT | XR_VIEW_STATE_POSITION_VALID_BIT;
  XrViewLocateInfo info{};
  info.type = XR_TYPE_VIEW_LOCATE_INFO;
  info.viewConfigurationType = kStereo;
  info.displayTime = frame.display_time;
  info.space = space_.handle();
  XrViewState state{};
  state.type = XR_TYPE_VIEW_STATE;
  std::array<XrView, 2> views{};
  views.fill({XR_TYPE_VIEW, nullptr, kIdentityPose, {}});
  std::uint32_t count = 2;
  check(xrLocateViews(session_.handle(), &info, &state, 2, &count, views.data()), "xrLocateViews");
  const auto head = view_space_.locate_in(space_, frame.display_time);
  if ((state.viewStateFlags & kNeeded) != kNeeded || !head) {
    frame.should_render = false;
    return;
  }
  located_ = views;
  frame.space_from_head = *head;
  const tracking::Pose head_from_space = head->inverse();
  for (const Side side : {Side::right, Side::left}) {
    const XrView& view = views[view_index(side)];
    const tracking::Pose space_from_view = pose_of(view.pose);
    frame.views[static_cast<std::size_t>(side)] = {space_from_view, head_from_space * space_from_view,
                                                   fov_of(view.fov)};
  }
}

std::array<std::uint32_t, 2> FrameLoop::acquire() {
  std::array<std::uint32_t, 2> images{};
  std::ranges::transform(swapchains_, images.begin(), [](const auto& swapchain) { return swapchain->acquire(); });
  return images;
}

void FrameLoop::show(const Frame& frame, std::span<const Panel* const> panels) {
  std::array<XrCompositionLayerProjectionView, 2> views{};
  for (const Side side : {Side::right, Side::left}) {
    Swapchain& swapchain = *swapchains_[static_cast<std::size_t>(side)];
    swapchain.release();
    XrCompositionLayerProjectionView& view = views[view_index(side)];
    view.type = XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW;
    view.pose = located_[view_index(side)].pose;
    view.fov = located_[view_index(side)].fov;
    view.subImage.swapchain = swapchain.handle();
    view.subImage.imageRect.extent = {swapchain.width(), swapchain.height()};
  }
  XrCompositionLayerProjection layer{};
  layer.type = XR_TYPE_COMPOSITION_LAYER_PROJECTION;
  layer.space = space_.handle();
  layer.viewCount = 2;
  layer.views = views.data();
  std::vector<XrCompositionLayerQuad> quads;
  for (const Panel* panel : panels) {
    if (!panel->is_empty()) {
      quads.push_back(panel->layer());
    }
  }
  std::vector layers{reinterpret_cast<const XrCompositionLayerBaseHeader*>(&layer)};
  std::ranges::transform(quads, std::back_inserter(layers), [](const XrCompositionLayerQuad& quad) {
    return reinterpret_cast<const XrCompositionLayerBaseHeader*>(&quad);
  });
  end(frame, layers);
}

void FrameLoop::skip(const Frame& frame) {
  end(frame, {});
}

void FrameLoop::end(const Frame& frame, std::span<const XrCompositionLayerBaseHeader* const> layers) {
  XrFrameEndInfo info{};
  info.type = XR_TYPE_FRAME_END_INFO;
  info.displayTime = frame.display_time;
  info.environmentBlendMode = blend_mode_;
  info.layerCount = static_cast<std::uint32_t>(layers.size());
  info.layers = layers.empty() ? nullptr : layers.data();
  check(xrEndFrame(session_.handle(), &info), "xrEndFrame");
}

}  // namespace xr
