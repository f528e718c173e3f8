#include "render/traversal_choice.hpp"

#include <algorithm>
#include <chrono>
#include <limits>

#include "render/frame_job.hpp"

namespace render {
namespace {

constexpr int kMeasuredSide = 256;  // pixels
constexpr int kMeasuredRounds = 3;

// Milliseconds for the trace stage alone; compiles first.
class TimedTrace {
 public:
  TimedTrace(vk::Device& device, const SceneBuffers& scene, KernelSet& kernels, const lenses::LensModel& lenses,
             const std::vector<ViewSetup>& views, const FrameConfig& frame, Traversal traversal)
      : device_(device),
        out_(device,
             {.pixels = static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height) * views.size(),
              .wavefront = keeps_wavefront(frame),
              .hits = traversal == Traversal::tile}),
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

 private:
  vk::Device& device_;
  FrameBuffers out_;
  FrameJob job_;
  vk::Commands commands_;
  double least_ = std::numeric_limits<double>::infinity();
};

}  // namespace

Traversal TraversalChoice::for_frame(vk::Device& device, const SceneBuffers& scene, KernelSet& kernels,
                                     const lenses::LensModel& lenses, const std::vector<ViewSetup>& views,
                                     const FrameConfig& frame) {
  const std::size_t pixels =
      static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height) * views.size();
  if (config_.traversal == Traversal::per_ray || !can_trace_tiles(device.limits()) ||
      pixels > device.limits().max_texel_elements) {
    return Traversal::per_ray;
  }
  if (config_.traversal == Traversal::tile) {
    return Traversal::tile;
  }
  const bool bare =
      std::ranges::all_of(views, [&](const ViewSetup& view) { return lenses.lens[view.lens].glass.w == 0.0; });
  const RayKind kind = bare ? RayKind::bare : RayKind::refracted;
  if (const auto known = known_.find(kind); known != known_.end()) {
    return known->second;
  }
  const TraversalRecord record(config_.traversal_file, device.name());
  std::optional<Traversal> choice = record.find(kind);
  if (!choice) {
    FrameConfig small = frame;
    small.width = std::min(small.width, kMeasuredSide);
    small.height = std::min(small.height, kMeasuredSide);
    TimedTrace per_ray(device, scene, kernels, lenses, views, small, Traversal::per_ray);
    TimedTrace tile(device, scene, kernels, lenses, views, small, Traversal::tile);
    for (int round = 0; round < kMeasuredRounds; ++round) {
      per_ray.run();
      tile.run();
    }
    choice = tile.least() < per_ray.least() ? Traversal::tile : Traversal::per_ray;
    record.keep(kind, *choice);
  }
  return known_[kind] = *choice;
}

}  // namespace render
