// Where two eyes look, through their lenses, and the one accommodation state that comes of it. On the CPU in double:
// it is solved once a frame.
#pragma once

#include <array>
#include <optional>

#include "lenses/lens_model.hpp"
#include "render/scene/ray_query.hpp"
#include "render/view_setup.hpp"
#include "tracking/stereo_view.hpp"

namespace render {

// One eye behind its lens.
struct EyeOptics {
  lenses::f64::LensData lens;
  lenses::f64::EyeData eye;
  tracking::Pose world_from_eye;
};

struct LineOfSight {
  glm::dvec3 gaze{0.0, 0.0, -1.0};  // before the lens, primary axes, unit
  bool through_lens = false;        // false: beside it, into its rim, or no lens
  glm::dvec3 start{0.0};            // of the ray into the scene, world
  glm::dvec3 direction{0.0};        // world, unit
  glm::dvec3 point{0.0};            // what it looks at, world; far away for the sky
};

// The line of sight of an eye that looks along `gaze` (primary axes).
[[nodiscard]] LineOfSight look_along(const lenses::f64::Table& table, const EyeOptics& eye, Viewing viewing,
                                     const glm::dvec3& gaze);

// The gaze whose refracted ray passes through a point of the world (straight casting misses by 3 deg at 20 deg through
// 6 D). Where no ray through the lens gets there, the straight line.
[[nodiscard]] LineOfSight look_at(const lenses::f64::Table& table, const EyeOptics& eye, Viewing viewing,
                                  const glm::dvec3& target);

struct Fixation {
  double distance = 0.0;                  // m from the midpoint between the eyes, infinite for the sky
  std::array<LineOfSight, 2> line;        // indexed by Side
  std::array<double, 2> demand{};         // accommodation each eye asks for, D, not limited; infinite if none
  std::array<double, 2> accommodation{};  // the state: the lesser demand, limited by each eye's own amplitude, D
};

// The middle of both pupils in primary gaze, world.
[[nodiscard]] glm::dvec3 midpoint(const std::array<EyeOptics, 2>& eyes);

// Demands and accommodation of two lines whose gaze and point are known.
void accommodate(Fixation& fixation, const lenses::f64::Table& table, const std::array<EyeOptics, 2>& eyes,
                 Viewing viewing);

// Both eyes on one point of the world.
[[nodiscard]] Fixation fixate(const lenses::f64::Table& table, const std::array<EyeOptics, 2>& eyes, Viewing viewing,
                              const glm::dvec3& point, double distance);

// Each eye along the same gaze (head axes) through its own lens, parallel, at whatever its line meets: the inspection
// views, which have no fixated point in common.
[[nodiscard]] Fixation look_parallel(const lenses::f64::Table& table, const std::array<EyeOptics, 2>& eyes,
                                     Viewing viewing, const glm::dvec3& gaze, const RayQuery& scene);

// One combined gaze (head axes, from midway between the eyes): each eye's lens turns it, the mean of the two refracted
// directions meets the scene, and each eye's line is solved to that point.
[[nodiscard]] Fixation fixate_along(const lenses::f64::Table& table, const std::array<EyeOptics, 2>& eyes,
                                    Viewing viewing, const glm::dvec3& gaze, const RayQuery& scene);

}  // namespace render
