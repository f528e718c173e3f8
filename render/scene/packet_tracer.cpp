#include "render/scene/packet_tracer.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <thread>

#include "render/scene/cut_out.hpp"
#include "render/scene/embree_device.hpp"

namespace render {
namespace {

constexpr std::size_t kWidth = 16;
constexpr std::size_t kPacketsAtOnce = 256;  // what a thread takes from the list

// Triangles of one geometry: those that need no second look, those with a back that is not seen, those with holes.
// Embree asks its filter only for hits of a geometry that has one.
struct Group {
  std::vector<std::uint32_t> triangles;  // indices into Scene::triangles, by Embree's primID
  std::vector<bool> single_sided;
  std::optional<CutOuts> cut_outs;
  bool looks_twice = false;

  void add(std::uint32_t triangle, const Material& material) {
    triangles.push_back(triangle);
    single_sided.push_back(!material.double_sided);
  }
};

enum : std::size_t { kPlain, kCulled, kCutOut, kGroups };

std::array<Group, kGroups> grouped(const Scene& scene) {
  std::array<Group, kGroups> groups;
  for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
    const Material& material = scene.materials.at(scene.triangle_material[i]);
    const std::size_t group = material.alpha == Material::Alpha::mask ? kCutOut
                              : material.double_sided                 ? kPlain
                                                                      : kCulled;
    groups[group].add(static_cast<std::uint32_t>(i), material);
  }
  groups[kCulled].looks_twice = groups[kCutOut].looks_twice = true;
  groups[kCutOut].cut_outs.emplace(scene, groups[kCutOut].triangles);
  return groups;
}

// Called with up to 16 hits that are nearer than any before; what is not there lets its ray go on.
void refuse_what_is_not_there(const RTCFilterFunctionNArguments* hits) {
  const Group& group = *static_cast<const Group*>(hits->geometryUserPtr);
  const unsigned n = hits->N;
  for (unsigned i = 0; i < n; ++i) {
    if (hits->valid[i] != -1) continue;
    const unsigned place = RTCHitN_primID(hits->hit, n, i);
    const glm::vec3 normal(RTCHitN_Ng_x(hits->hit, n, i), RTCHitN_Ng_y(hits->hit, n, i), RTCHitN_Ng_z(hits->hit, n, i));
    const glm::vec3 along(RTCRayN_dir_x(hits->ray, n, i), RTCRayN_dir_y(hits->ray, n, i),
                          RTCRayN_dir_z(hits->ray, n, i));
    const bool is_back = group.single_sided[place] && glm::dot(normal, along) > 0.0F;
    const bool is_hole =
        group.cut_outs && group.cut_outs->is_hole(place, RTCHitN_u(hits->hit, n, i), RTCHitN_v(hits->hit, n, i));
    if (is_back || is_hole) hits->valid[i] = 0;
  }
}

RTCRayHit16 trace_packet(RTCScene scene, std::span<const SceneRay> rays) {
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
  return packet;
}

}  // namespace

struct PacketTracer::State {
  EmbreeDevice device;
  EmbreeScene scene;
  std::vector<glm::vec3> positions;  // Embree reads them here
  std::array<Group, kGroups> groups;

  void attach(Group& group, unsigned id, const Scene& source) {
    if (group.triangles.empty()) return;
    const EmbreeGeometry geometry(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
    rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, positions.data(), 0,
                               sizeof(glm::vec3), source.vertices.size());
    auto* indices = static_cast<glm::uvec3*>(rtcSetNewGeometryBuffer(
        geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3), group.triangles.size()));
    check_embree(device.get(), "rtcSetNewGeometryBuffer");
    std::ranges::transform(group.triangles, indices, [&](std::uint32_t i) { return source.triangles[i]; });
    if (group.looks_twice) {
      rtcSetGeometryUserData(geometry.get(), &group);
      rtcSetGeometryIntersectFilterFunction(geometry.get(), refuse_what_is_not_there);
    }
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometryByID(scene.get(), geometry.get(), id);
  }
};

PacketTracer::PacketTracer(const Scene& scene) : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.device = make_embree_device();
  s.scene.reset(rtcNewScene(s.device.get()));
  rtcSetSceneBuildQuality(s.scene.get(), RTC_BUILD_QUALITY_HIGH);  // the best that the peer can do
  s.positions.reserve(scene.vertices.size() + 1);
  for (const Vertex& vertex : scene.vertices) s.positions.push_back(vertex.position);
  s.positions.emplace_back(0.0F);  // Embree loads 16 bytes of the last one
  s.groups = grouped(scene);
  for (unsigned id = 0; id < kGroups; ++id) s.attach(s.groups[id], id, scene);
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
        const std::size_t width = std::min(kWidth, end - i);
        const RTCRayHit16 packet = trace_packet(state_->scene.get(), rays.subspan(i, width));
        found += width - static_cast<std::size_t>(
                             std::count(packet.hit.geomID, packet.hit.geomID + width, RTC_INVALID_GEOMETRY_ID));
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

std::vector<std::uint32_t> PacketTracer::triangles_hit(std::span<const SceneRay> rays) const {
  std::vector<std::uint32_t> found;
  found.reserve(rays.size());
  for (std::size_t i = 0; i < rays.size(); i += kWidth) {
    const std::size_t width = std::min(kWidth, rays.size() - i);
    const RTCRayHit16 packet = trace_packet(state_->scene.get(), rays.subspan(i, width));
    for (std::size_t j = 0; j < width; ++j) {
      const unsigned group = packet.hit.geomID[j];
      found.push_back(group == RTC_INVALID_GEOMETRY_ID ? kNoTriangle
                                                       : state_->groups[group].triangles[packet.hit.primID[j]]);
    }
  }
  return found;
}

}  // namespace render
