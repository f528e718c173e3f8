// The peer that the GPU's tracing is measured against: Embree's packets of 16 rays on all threads of the CPU. A ray
// goes on past backs of single-sided triangles and through holes of cut-out ones, as the shaders' rays do; what blends
// stops it, where a shader's ray looks for the layer behind.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "render/scene/scene.hpp"

namespace render {

struct SceneRay {
  glm::vec3 origin, direction;  // m, world; the direction a unit vector
};

class PacketTracer {
 public:
  // Keeps a copy of what it needs; the scene may go.
  explicit PacketTracer(const Scene& scene);
  ~PacketTracer();
  PacketTracer(PacketTracer&&) noexcept;
  PacketTracer& operator=(PacketTracer&&) noexcept;
  PacketTracer(const PacketTracer&) = delete;
  PacketTracer& operator=(const PacketTracer&) = delete;

  struct Result {
    double milliseconds = 0.0;
    std::size_t hits = 0;
  };
  // The closest hit of every ray, 16 neighbours of the list at a time.
  [[nodiscard]] Result trace(std::span<const SceneRay> rays, unsigned threads) const;

  static constexpr std::uint32_t kNoTriangle = 0xFFFFFFFFU;
  // What each ray hits, an index into Scene::triangles: the same packets, on one thread and untimed.
  [[nodiscard]] std::vector<std::uint32_t> triangles_hit(std::span<const SceneRay> rays) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace render
