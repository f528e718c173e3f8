#include "render/fixation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace render {
namespace {

using lenses::f64::SightLine;

constexpr double kSkyDistance = 1e6;  // m; a point there and one at infinity differ by 1e-6 D

SightLine sight_line(const lenses::f64::Table& table, const EyeOptics& eye, Viewing viewing, const glm::dvec3& gaze) {
  const glm::dmat3 turn = lenses::f64::eye_turn(static_cast<int>(viewing), gaze, gaze);
  return lenses::f64::trace_sight_line(table, eye.lens, eye.eye, turn, gaze, glm::dvec2(0.0), glm::dvec2(0.0));
}

LineOfSight to_world(const EyeOptics& eye, const SightLine& line, const glm::dvec3& gaze) {
  LineOfSight out;
  out.gaze = gaze;
  out.through_lens = line.status == lenses::f64::kStatusOk && eye.lens.glass.w != 0.0;
  out.start = eye.world_from_eye.point(out.through_lens ? line.start : line.pupil);
  out.direction =
      glm::normalize(eye.world_from_eye.direction(out.through_lens ? line.direction_object : line.direction));
  return out;
}

double demand_at(const lenses::f64::Table& table, const EyeOptics& eye, Viewing viewing, const LineOfSight& line) {
  const double q = 1.0 / std::max(glm::length(line.point - line.start), 1e-3);
  glm::dvec3 vergence(-q, 0.0, -q);
  if (line.through_lens) {
    const SightLine sight = sight_line(table, eye, viewing, line.gaze);
    int status = lenses::f64::kStatusOk;
    vergence = lenses::f64::sight_line_vergence(lenses::f64::sight_line_transfer(eye.lens, sight), q, status);
    if (status != lenses::f64::kStatusOk) {
      return std::numeric_limits<double>::infinity();
    }
  }
  return lenses::f64::accommodation_demand(vergence, eye.eye);
}

}  // namespace

LineOfSight look_along(const lenses::f64::Table& table, const EyeOptics& eye, Viewing viewing, const glm::dvec3& gaze) {
  const glm::dvec3 unit = glm::normalize(gaze);
  return to_world(eye, sight_line(table, eye, viewing, unit), unit);
}

LineOfSight look_at(const lenses::f64::Table& table, const EyeOptics& eye, Viewing viewing, const glm::dvec3& target) {
  constexpr int kSteps = 60;
  const glm::dvec3 goal = eye.world_from_eye.inverse().point(target);
  glm::dvec3 gaze = glm::normalize(goal);
  EyeOptics bare = eye;
  bare.lens.glass.w = 0.0;
  // The refracted ray misses the target by a small angle; turning the gaze by that angle is Newton's method with the
  // lens's unit magnification for a Jacobian, which contracts for every lens an eye can look through.
  const auto solve = [&](const EyeOptics& through) {
    glm::dvec3 g = gaze;
    for (int i = 0; i < kSteps; ++i) {
      const SightLine line = sight_line(table, through, viewing, g);
      if (line.status != lenses::f64::kStatusOk) {
        return g;
      }
      const glm::dvec3 miss = glm::normalize(goal - line.start) - line.direction_object;
      g = glm::normalize(g + miss);
      if (glm::length(miss) < 1e-13) {
        break;
      }
    }
    return g;
  };
  const glm::dvec3 through_lens = solve(eye);
  const SightLine line = sight_line(table, eye, viewing, through_lens);
  if (line.status == lenses::f64::kStatusOk &&
      glm::length(glm::normalize(goal - line.start) - line.direction_object) < 1e-6) {
    return to_world(eye, line, through_lens);
  }
  const glm::dvec3 straight = solve(bare);
  return to_world(bare, sight_line(table, bare, viewing, straight), straight);
}

// One neural drive for both eyes: it stops at the eye that asks for less, and each eye follows as far as it can.
void accommodate(Fixation& fixation, const lenses::f64::Table& table, const std::array<EyeOptics, 2>& eyes,
                 Viewing viewing) {
  for (std::size_t i = 0; i < 2; ++i) {
    fixation.demand[i] = demand_at(table, eyes[i], viewing, fixation.line[i]);
  }
  const double lesser = std::min(fixation.demand[0], fixation.demand[1]);
  const double drive = std::isfinite(lesser) ? std::max(0.0, lesser) : 0.0;
  for (std::size_t i = 0; i < 2; ++i) {
    fixation.accommodation[i] = std::min(drive, eyes[i].eye.excess.w);
  }
}

glm::dvec3 midpoint(const std::array<EyeOptics, 2>& eyes) {
  return 0.5 * (eyes[0].world_from_eye.position + eyes[1].world_from_eye.position);
}

Fixation fixate(const lenses::f64::Table& table, const std::array<EyeOptics, 2>& eyes, Viewing viewing,
                const glm::dvec3& point, double distance) {
  Fixation fixation;
  fixation.distance = distance;
  for (std::size_t i = 0; i < 2; ++i) {
    fixation.line[i] = look_at(table, eyes[i], viewing, point);
    fixation.line[i].point = point;
  }
  accommodate(fixation, table, eyes, viewing);
  return fixation;
}

Fixation look_parallel(const lenses::f64::Table& table, const std::array<EyeOptics, 2>& eyes, Viewing viewing,
                       const glm::dvec3& gaze, const RayQuery& scene) {
  Fixation fixation;
  fixation.distance = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 2; ++i) {
    LineOfSight& line = fixation.line[i];
    line = look_along(table, eyes[i], viewing, gaze);
    const auto hit = scene.looked_at(line.start, line.direction);
    line.point = line.start + (hit ? hit->distance : kSkyDistance) * line.direction;
    if (hit) {
      fixation.distance = std::min(fixation.distance, glm::length(line.point - midpoint(eyes)));
    }
  }
  accommodate(fixation, table, eyes, viewing);
  return fixation;
}

Fixation fixate_along(const lenses::f64::Table& table, const std::array<EyeOptics, 2>& eyes, Viewing viewing,
                      const glm::dvec3& gaze, const RayQuery& scene) {
  const LineOfSight right = look_along(table, eyes[0], viewing, gaze);
  const LineOfSight left = look_along(table, eyes[1], viewing, gaze);
  const glm::dvec3 start = 0.5 * (right.start + left.start);
  const glm::dvec3 direction = glm::normalize(right.direction + left.direction);
  const auto hit = scene.looked_at(start, direction);
  const glm::dvec3 point = start + (hit ? hit->distance : kSkyDistance) * direction;
  return fixate(table, eyes, viewing, point,
                hit ? glm::length(point - midpoint(eyes)) : std::numeric_limits<double>::infinity());
}

}  // namespace render
