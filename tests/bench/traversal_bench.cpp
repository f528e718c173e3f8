// Milliseconds a stage of each traversal against Embree's Intersect16 on the same rays in the same run:
//   traversal_bench [SIZE [ROUNDS]]
// VERGENCE_BENCH_SHADOWS: with shadow rays; VERGENCE_BENCH_TRACE: no edges and no blur; VERGENCE_BENCH_CLUTTER_ONLY:
// without the reading room.
// Medians (least in brackets) of interleaved rounds. One view of the right eye; a row a scene, lens and traversal.
#include <cstdio>
#include <cstdlib>
#include <map>
#include <optional>
#include <thread>

#include "render/scene/packet_tracer.hpp"
#include "render/vk/device.hpp"
#include "tests/support/cluttered_room.hpp"
#include "tests/support/worn_views.hpp"

namespace {

using Times = std::map<std::string, std::vector<double>>;

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0.0 : values[values.size() / 2];
}

// Tile by tile, so that sixteen rays in a row are as near each other as a packet tracer could wish.
std::vector<render::SceneRay> rays_of(const support::WornPair& pair, const render::ViewSetup& view, int size) {
  std::vector<render::SceneRay> rays;
  for (int tile_y = 0; tile_y < size; tile_y += 4) {
    for (int tile_x = 0; tile_x < size; tile_x += 4) {
      for (int i = 0; i < 16; ++i) {
        const auto direction = support::pixel_direction(view, tile_x + i % 4, tile_y + i / 4, size, size);
        const auto pixel = support::reference_pixel(pair, view, direction);
        rays.push_back({glm::vec3(pixel.start), glm::vec3(pixel.direction)});
      }
    }
  }
  return rays;
}

void bench(render::vk::Device& device, const char* scene_name, const render::Scene& scene, int size, int rounds) {
  const render::PacketTracer embree(scene);
  render::Renderer per_ray(device, scene, {.traversal = render::Traversal::per_ray});
  render::Renderer tile(device, scene, {.traversal = render::Traversal::tile});
  std::vector<std::pair<const char*, render::Renderer*>> renderers{{"per_ray", &per_ray}, {"tile", &tile}};
  std::optional<render::Renderer> ray_query;
  if (device.limits().has_ray_query) {
    renderers.emplace_back(
        "ray_query",
        &ray_query.emplace(device, scene, render::RendererConfig{.traversal = render::Traversal::ray_query}));
  }
  const tracking::Pose head = scene.start_pose().value_or(tracking::Pose{});
  const auto progressive = lenses::read_spectacles(VERGENCE_ASSETS "/spectacles/presbyopia_bspline_sphere.json");
  for (const bool worn : {false, true}) {
    const auto pair = support::wear(lenses::Wearer{}, worn ? &progressive : nullptr, head);
    const auto fov = tracking::FieldOfView::symmetric(60.0 * support::kDegree, 1.0);
    const auto view = support::view_along(pair, 0, render::Viewing::fixed, {0.0, 0.0, -1.0}, fov);
    const auto rays = rays_of(pair, view, size);
    render::FrameConfig config;
    config.width = config.height = size;
    config.bare = std::getenv("VERGENCE_BENCH_SHADOWS") == nullptr;
    if (std::getenv("VERGENCE_BENCH_TRACE") != nullptr) {  // a map: no edges and no blur
      config.mode = render::Mode::power;
      config.range = render::MapRange{0.0, 1.0};
    }
    std::map<std::string, Times> times;
    std::vector<double> peer;
    for (int round = -1; round < rounds; ++round) {
      const double ms = embree.trace(rays, std::thread::hardware_concurrency()).milliseconds;
      if (round >= 0) peer.push_back(ms);
      for (const auto& [name, renderer] : renderers) {
        const auto frame = renderer->render(pair.model, {view}, config);
        double all = 0.0;
        for (const auto& stage : frame.stages) {
          if (round >= 0) times[name][stage.name].push_back(stage.milliseconds);
          all += stage.milliseconds;
        }
        if (round >= 0) times[name]["all"].push_back(all);
      }
    }
    const double count = static_cast<double>(rays.size());
    const double reference = median(peer);
    std::printf("%s, %zu triangles, %s, %d x %d: Embree Intersect16 %.1f (%.1f) ms, %.1f Mrays/s\n", scene_name,
                scene.triangles.size(), worn ? "bspline/sphere" : "none", size, size, reference,
                *std::min_element(peer.begin(), peer.end()), count / reference / 1e3);
    for (const auto& [name, stages] : times) {
      std::printf("  %-9s", name.c_str());
      for (const auto& [stage, list] : stages)
        std::printf(" %s %.1f (%.1f)", stage.c_str(), median(list), *std::min_element(list.begin(), list.end()));
      std::printf("  frame/Embree %.2f\n", median(stages.at("all")) / reference);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int size = argc > 1 ? std::atoi(argv[1]) : 1024;
  const int rounds = argc > 2 ? std::atoi(argv[2]) : 5;
  render::vk::Device device;
  std::printf("%s, subgroups of %u\n", device.name().c_str(), device.limits().subgroup_size);
  if (std::getenv("VERGENCE_BENCH_CLUTTER_ONLY") == nullptr)
    bench(device, "reading room", support::reading_room(), size, rounds);
  bench(device, "cluttered room", support::cluttered_room(1, 300000), size, rounds);
  return 0;
}
