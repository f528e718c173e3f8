// A tracker's gaze through the lenses: what eyes that are turned so look at, and, from one line for both, how far each
// eye turns. Once or twice a frame, on the CPU in double.
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <optional>

#include "render/fixation.hpp"
#include "tracking/live_state.hpp"

namespace render {

// What a ray of the world meets first, m along its unit direction; nothing: the sky.
using SceneAlong = std::function<std::optional<double>(const glm::dvec3& origin, const glm::dvec3& direction)>;

// Refers to the query, which must outlive it and stay where it is.
[[nodiscard]] SceneAlong scene_along(const RayQuery& query);

// The direction, from midway between two eyes whose lines have these directions, to where the lines meet; all in head
// axes. On a plane across the head's axis the point is the mean of the lines' points, whatever its distance.
[[nodiscard]] glm::dvec3 combined_direction(const std::array<glm::dvec3, 2>& gaze);

// One line for both eyes, before the lenses: both eyes' refracted lines are solved to reach one point of the scene, the
// point being the one for which their directions before the lenses combine to that line. `distance` (m from the
// midpoint between the eyes, may be infinite): a point so far instead of the scene's.
[[nodiscard]] Fixation fixate_combined(const lenses::f64::Table& table, const std::array<EyeOptics, 2>& eyes,
                                       Viewing viewing, const tracking::Pose& world_from_head,
                                       const tracking::Line& gaze, const SceneAlong& scene,
                                       std::optional<double> distance = std::nullopt);

// Each eye along its own gaze (head axes) through its own lens. The distance is where the refracted lines say they
// meet, or what the scene has near there; each eye's point lies so far along its own line.
[[nodiscard]] Fixation fixate_each(const lenses::f64::Table& table, const std::array<EyeOptics, 2>& eyes,
                                   Viewing viewing, const std::array<glm::dvec3, 2>& gaze, double direction_noise,
                                   const SceneAlong& scene, std::optional<double> distance = std::nullopt);

// Either, as the request says: the answer to tracking::LiveState. Head axes are the eyes' primary axes.
[[nodiscard]] Fixation look(const lenses::f64::Table& table, const std::array<EyeOptics, 2>& eyes, Viewing viewing,
                            const tracking::LookRequest& request, double direction_noise, const SceneAlong& scene);

[[nodiscard]] tracking::LookedAt looked_at(const Fixation& fixation);

}  // namespace render
