// Single rays against a scene on the CPU, for fixation (what does this gaze look at?) and as an independent check of
// the shaders' traversal.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>

#include "render/scene/scene.hpp"

namespace render {

class RayQuery {
 public:
  // Keeps a copy of what it needs; the scene may go.
  explicit RayQuery(const Scene& scene);
  ~RayQuery();
  RayQuery(RayQuery&&) noexcept;
  RayQuery& operator=(RayQuery&&) noexcept;
  RayQuery(const RayQuery&) = delete;
  RayQuery& operator=(const RayQuery&) = delete;

  struct Hit {
    double distance;         // m along the ray, whatever the direction's length
    std::uint32_t triangle;  // index into Scene::triangles
  };
  // The first triangle ahead of origin (m, world), from either side. Nothing for a ray that is not finite or has no
  // direction. Safe to call from several threads.
  [[nodiscard]] std::optional<Hit> closest(glm::dvec3 origin, glm::dvec3 direction) const;

  // The same for an eye that looks: past the backs of single-sided triangles and past what blends with less than half
  // of the light behind it, and through holes of cut-out ones.
  [[nodiscard]] std::optional<Hit> looked_at(glm::dvec3 origin, glm::dvec3 direction) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace render
