#include "render/scene/packet_tracer.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <limits>
#include <thread>
#include <vector>

#include "render/scene/embree_device.hpp"

namespace render {
namespace {

constexpr std::size_t kWidth = 16;
constexpr std::size_t kPacketsAtOnce = 256;  // what a thread takes from the list

std::size_t trace_packet(RTCScene scene, std::span<const SceneRay> rays) {
  alignas(64) std::array<int, kWidth> valid{};
  alignas(64) RTCRayHit16 packet{};
  for (std::size_t i = 0; i < rays.size(); ++i) {
    valid[i] = -1;
    packet.ray.org_x[i] = rays[i].origin.x;
    packet.ray.org_y[i] = rays[i].origin.y;
    packet.ray.org_z[i] = rays[i].origin.z;
    packet.ray.dir_x[i] = rays[i].direction.x;
    packet.ray.dir_y[i] = rays[i].direction.y;
    packet.ray.dir_z[i] = rays[i].direction.z;
    packet.ray.tfar[i] = std::numeric_limits<float>::infinity();
    packet.ray.mask[i] = 0xFFFFFFFFU;
    packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
  }
  intersect_sixteen(valid.data(), scene, packet);
  std::size_t hits = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) hits += packet.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID ? 1 : 0;
  return hits;
}

}  // namespace

struct PacketTracer::State {
  EmbreeDevice device;
  EmbreeScene scene;
};

PacketTracer::PacketTracer(const Scene& scene) : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.device = make_embree_device();
  s.scene.reset(rtcNewScene(s.device.get()));
  const EmbreeGeometry geometry(rtcNewGeometry(s.device.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
  auto* vertices = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
      geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), scene.vertices.size()));
  auto* indices = static_cast<glm::uvec3*>(rtcSetNewGeometryBuffer(
      geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3), scene.triangles.size()));
  check_embree(s.device.get(), "rtcSetNewGeometryBuffer");
  std::ranges::transform(scene.vertices, vertices, &Vertex::position);
  std::ranges::copy(scene.triangles, indices);
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometry(s.scene.get(), geometry.get());
  rtcCommitScene(s.scene.get());
  check_embree(s.device.get(), "rtcCommitScene");
}

PacketTracer::~PacketTracer() = default;
PacketTracer::PacketTracer(PacketTracer&&) noexcept = default;
PacketTracer& PacketTracer::operator=(PacketTracer&&) noexcept = default;

PacketTracer::Result PacketTracer::trace(std::span<const SceneRay> rays, unsigned threads) const {
  std::atomic<std::size_t> next{0}, hits{0};
  const auto work = [&] {
    constexpr std::size_t kChunk = kWidth * kPacketsAtOnce;
    std::size_t found = 0;
    for (std::size_t begin = next.fetch_add(kChunk); begin < rays.size(); begin = next.fetch_add(kChunk)) {
      const std::size_t end = std::min(begin + kChunk, rays.size());
      for (std::size_t i = begin; i < end; i += kWidth) {
        found += trace_packet(state_->scene.get(), rays.subspan(i, std::min(kWidth, end - i)));
      }
    }
    hits += found;
  };
  const auto start = std::chrono::steady_clock::now();
  {
    std::vector<std::jthread> others;
    for (unsigned i = 1; i < threads; ++i) others.emplace_back(work);
    work();
  }
  const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
  check_embree(state_->device.get(), "rtcIntersect16");
  return {time.count(), hits};
}

}  // namespace render
