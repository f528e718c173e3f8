#include "render/traversal_choice.hpp"

#include <algorithm>
#include <chrono>
#include <limits>
#include <list>
#include <optional>
#include <utility>

#include "render/frame_job.hpp"

namespace render {
namespace {

constexpr int kMeasuredSide = 256;  // pixels
constexpr int kMeasuredRounds = 3;
constexpr double kHopeless = 4.0;  // so many times slower than the best is not timed again

// Milliseconds for the trace stage alone; compiles first.
class TimedTrace {
 public:
  TimedTrace(vk::Device& device, const SceneBuffers& scene, KernelSet& kernels, const lenses::LensModel& lenses,
             const std::vector<ViewSetup>& views, const FrameConfig& frame, Traversal traversal)
      : device_(device),
        traversal_(traversal),
        out_(device, buffers_for(frame, views, traversal)),
        job_(device, scene, kernels, out_, lenses, views, frame, traversal),
        commands_(device) {
    job_.record_trace(commands_);
    device_.run(commands_);
  }

  void run() {
    const auto start = std::chrono::steady_clock::now();
    device_.run(commands_);
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
    least_ = std::min(least_, took.count());
  }

  [[nodiscard]] double least() const { return least_; }
  [[nodiscard]] Traversal traversal() const { return traversal_; }

 private:
  vk::Device& device_;
  Traversal traversal_;
  FrameBuffers out_;
  FrameJob job_;
  vk::Commands commands_;
  double least_ = std::numeric_limits<double>::infinity();
};

// What can find the hits of so many pixels here.
std::vector<Traversal> offered(const vk::DeviceLimits& limits, std::size_t pixels) {
  std::vector<Traversal> all{Traversal::per_ray};
  if (pixels > limits.max_texel_elements) {
    return all;  // their rays do not fit a buffer
  }
  if (can_trace_tiles(limits)) {
    all.push_back(Traversal::tile);
  }
  if (limits.has_ray_query) {
    all.push_back(Traversal::ray_query);
  }
  return all;
}

}  // namespace

TraversalChoice::TraversalChoice(const vk::Device& device, RendererConfig config) : config_(std::move(config)) {
  if (config_.traversal == Traversal::ray_query && !device.limits().has_ray_query) {
    throw vk::DeviceError(device.name() + " has no ray queries (VK_KHR_ray_query); trace per ray or by tile there");
  }
}

Traversal TraversalChoice::for_frame(vk::Device& device, const SceneBuffers& scene, KernelSet& kernels,
                                     const lenses::LensModel& lenses, const std::vector<ViewSetup>& views,
                                     const FrameConfig& frame) {
  const std::size_t pixels =
      static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height) * views.size();
  const std::vector<Traversal> possible = offered(device.limits(), pixels);
  const auto is_possible = [&](Traversal traversal) {
    return std::ranges::find(possible, traversal) != possible.end();
  };
  if (possible.size() == 1 || config_.traversal != Traversal::automatic) {
    return is_possible(config_.traversal) ? config_.traversal : Traversal::per_ray;
  }
  const bool bare =
      std::ranges::all_of(views, [&](const ViewSetup& view) { return lenses.lens[view.lens].glass.w == 0.0; });
  const RayKind kind = bare ? RayKind::bare : RayKind::refracted;
  if (const auto known = known_.find(kind); known != known_.end()) {
    return known->second;
  }
  const TraversalRecord record(config_.traversal_file, device.name());
  std::optional<Traversal> choice = record.find(kind);
  if (!choice || !is_possible(*choice)) {  // another driver may go by the same name
    FrameConfig small = frame;
    small.width = kMeasuredSide;  // whatever frame happens to be the first
    small.height = kMeasuredSide;
    std::list<TimedTrace> traces;  // they stay where they are
    for (const Traversal traversal : possible) {
      try {
        traces.emplace_back(device, scene, kernels, lenses, views, small, traversal);
      } catch (const vk::DeviceError&) {
        if (traversal != Traversal::ray_query) {
          throw;
        }
        // No room for its acceleration structure: the others need none.
      }
    }
    for (int round = 0; round < kMeasuredRounds; ++round) {
      const double best = std::ranges::min_element(traces, {}, &TimedTrace::least)->least();
      for (TimedTrace& trace : traces) {
        if (trace.least() <= kHopeless * best) {
          trace.run();
        }
      }
    }
    choice = std::ranges::min_element(traces, {}, &TimedTrace::least)->traversal();
    record.keep(kind, *choice);
    if (*choice != Traversal::ray_query) {
      scene.drop_acceleration();
    }
  }
  return known_[kind] = *choice;
}

}  // namespace render
