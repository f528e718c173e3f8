// Embree's Intersect16 on a list of rays, as a peer for speed and as an oracle for hits.
#pragma once

#include <embree3/rtcore.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <stdexcept>
#include <thread>
#include <vector>

#include "render/scene/scene.hpp"

namespace support {

struct WorldRay {
  glm::vec3 origin, direction;
};

class EmbreePackets {
 public:
  struct Hit {
    float t;
    std::uint32_t triangle;  // RTC_INVALID_GEOMETRY_ID for none
  };

  explicit EmbreePackets(const render::Scene& scene) : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* positions = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), scene.vertices.size()));
    for (std::size_t i = 0; i < scene.vertices.size(); ++i) positions[i] = scene.vertices[i].position;
    auto* indices = static_cast<glm::uvec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3), scene.triangles.size()));
    std::copy(scene.triangles.begin(), scene.triangles.end(), indices);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
    if (rtcGetDeviceError(device_) != RTC_ERROR_NONE) throw std::runtime_error("Embree: no scene");
  }
  ~EmbreePackets() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  EmbreePackets(const EmbreePackets&) = delete;
  EmbreePackets& operator=(const EmbreePackets&) = delete;

  // On two threads; milliseconds of the intersections, packing and unpacking included.
  double intersect(std::span<const WorldRay> rays, std::span<Hit> hits) const {
    const auto start = std::chrono::steady_clock::now();
    std::atomic<std::size_t> next{0};
    const auto work = [&] {
      constexpr std::size_t kBatch = 4096;
      for (std::size_t at = next.fetch_add(kBatch); at < rays.size(); at = next.fetch_add(kBatch)) {
        const std::size_t end = std::min(at + kBatch, rays.size());
        for (std::size_t i = at; i < end; i += 16)
          packet(rays.subspan(i, std::min<std::size_t>(16, end - i)), &hits[i]);
      }
    };
    std::thread other(work);
    work();
    other.join();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  }

 private:
  void packet(std::span<const WorldRay> rays, Hit* hits) const {
    alignas(64) RTCRayHit16 p;
    alignas(64) int valid[16];
    for (std::size_t i = 0; i < 16; ++i) {
      const WorldRay& ray = rays[std::min(i, rays.size() - 1)];
      valid[i] = i < rays.size() ? -1 : 0;
      p.ray.org_x[i] = ray.origin.x;
      p.ray.org_y[i] = ray.origin.y;
      p.ray.org_z[i] = ray.origin.z;
      p.ray.dir_x[i] = ray.direction.x;
      p.ray.dir_y[i] = ray.direction.y;
      p.ray.dir_z[i] = ray.direction.z;
      p.ray.tnear[i] = 0.0F;
      p.ray.tfar[i] = 1e30F;
      p.ray.time[i] = 0.0F;
      p.ray.mask[i] = 0xFFFFFFFFU;
      p.ray.id[i] = 0;
      p.ray.flags[i] = 0;
      p.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
      p.hit.primID[i] = RTC_INVALID_GEOMETRY_ID;
      p.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect16(valid, scene_, &context, &p);
    for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = {p.ray.tfar[i], p.hit.primID[i]};
  }

  RTCDevice device_;
  RTCScene scene_;
};

}  // namespace support
