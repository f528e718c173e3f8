#include "render/live_gaze.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <vector>

#include "tracking/fixation_distance.hpp"

namespace render {
namespace {

constexpr double kSkyDistance = 1e6;  // m, as in fixation.cpp
constexpr int kSteps = 12;
constexpr double kSettled = 1e-9;      // of a direction's slope
constexpr double kLeastForward = 0.1;  // of -z: slopes are of directions within 84 degrees of the head's

// Of a direction on a plane across the head's axis.
glm::dvec2 slope(const glm::dvec3& d) {
  return glm::dvec2(d.x, d.y) / std::max(-d.z, kLeastForward);
}

glm::dvec3 direction(const glm::dvec2& slope) {
  return glm::normalize(glm::dvec3(slope, -1.0));
}

// Where a ray is so far from a centre near its start.
double along_to(const glm::dvec3& start, const glm::dvec3& direction, const glm::dvec3& centre, double distance) {
  if (!(distance < kSkyDistance)) {
    return kSkyDistance;
  }
  const glm::dvec3 from = start - centre;
  const double b = glm::dot(from, direction);
  const double inside = b * b - glm::dot(from, from) + distance * distance;
  // Nearer than the lenses nothing can be looked at.
  return std::max(1e-3, -b + std::sqrt(std::max(0.0, inside)));
}

// Both eyes' lenses turn a line before them; the mean of the two rays is what both together look along.
struct Ray {
  glm::dvec3 start, direction;
};
Ray through_both(const lenses::f64::Table& table, const std::array<EyeOptics, 2>& eyes, Viewing viewing,
                 const glm::dvec3& gaze) {
  const LineOfSight right = look_along(table, eyes[0], viewing, gaze);
  const LineOfSight left = look_along(table, eyes[1], viewing, gaze);
  return {0.5 * (right.start + left.start), glm::normalize(right.direction + left.direction)};
}

// What a ray meets, in the scene or at a distance from the midpoint between the eyes that is given.
struct Seen {
  glm::dvec3 point{0.0};
  double distance = std::numeric_limits<double>::infinity();  // of it from that midpoint
};
Seen seen_along(const Ray& ray, const glm::dvec3& middle, const SceneAlong& scene, std::optional<double> distance) {
  std::optional<double> along;
  if (!distance) {
    along = scene(ray.start, ray.direction);
  } else if (std::isfinite(*distance)) {
    along = along_to(ray.start, ray.direction, middle, *distance);
  }
  Seen seen;
  seen.point = ray.start + along.value_or(kSkyDistance) * ray.direction;
  if (along) {
    seen.distance = glm::length(seen.point - middle);
  }
  return seen;
}

// The slope of the line that a tracker would give for two eyes turned so, if its line began at `origin` (from midway
// between the eyes' centres of rotation, which their lines pass): towards where the eyes' lines meet before the lenses.
glm::dvec2 combined_slope(const std::array<glm::dvec3, 2>& gaze, double baseline, const glm::dvec3& origin) {
  const glm::dvec2 right = slope(gaze[0]), left = slope(gaze[1]);
  const glm::dvec2 mean = 0.5 * (right + left);
  const double nearness = std::max(0.0, (left.x - right.x) / baseline);  // 1/m along -z
  // From a point before the eyes the same point lies at a steeper slope, and it may not lie between the two.
  const double remaining = std::max(0.05, 1.0 + nearness * origin.z);
  return (mean - nearness * glm::dvec2(origin)) / remaining;
}

double dioptres(double distance) {
  return std::isfinite(distance) ? 1.0 / distance : 0.0;
}

}  // namespace

SceneAlong scene_along(const RayQuery& query) {
  return [&query](const glm::dvec3& origin, const glm::dvec3& direction) -> std::optional<double> {
    const auto hit = query.looked_at(origin, direction);
    return hit ? std::optional(hit->distance) : std::nullopt;
  };
}

glm::dvec3 combined_direction(const std::array<glm::dvec3, 2>& gaze) {
  return direction(0.5 * (slope(gaze[0]) + slope(gaze[1])));
}

Fixation fixate_combined(const lenses::f64::Table& table, const std::array<EyeOptics, 2>& eyes, Viewing viewing,
                         const tracking::Pose& world_from_head, const tracking::Line& gaze, const SceneAlong& scene,
                         std::optional<double> distance) {
  const glm::dvec3 middle = midpoint(eyes);
  const glm::dvec3 centre(0.0, 0.0, 0.5 * (eyes[0].eye.pupil.y + eyes[1].eye.pupil.y));
  const glm::dvec3 origin = gaze.origin - (world_from_head.inverse().point(middle) + centre);
  const double baseline =
      std::max(1e-3, glm::length(eyes[0].world_from_eye.position - eyes[1].world_from_eye.position));
  const glm::dvec2 wanted = slope(gaze.direction);
  glm::dvec2 cast = wanted;
  double least = std::numeric_limits<double>::infinity();
  Seen best;
  // Across an edge of the scene there may be no point that fits; then the nearest that was found is it.
  for (int i = 0; i < kSteps && least > kSettled; ++i) {
    const Seen seen = seen_along(through_both(table, eyes, viewing, direction(cast)), middle, scene, distance);
    std::array<glm::dvec3, 2> turned;
    for (std::size_t eye = 0; eye < 2; ++eye) {
      turned[eye] = look_at(table, eyes[eye], viewing, seen.point).gaze;
    }
    const glm::dvec2 miss = wanted - combined_slope(turned, baseline, origin);
    if (glm::length(miss) < least) {
      least = glm::length(miss);
      best = seen;
    }
    cast += miss;
  }
  return fixate(table, eyes, viewing, best.point, best.distance);
}

Fixation fixate_each(const lenses::f64::Table& table, const std::array<EyeOptics, 2>& eyes, Viewing viewing,
                     const std::array<glm::dvec3, 2>& gaze, double direction_noise, const SceneAlong& scene,
                     std::optional<double> distance) {
  const glm::dvec3 middle = midpoint(eyes);
  Fixation fixation;
  std::array<tracking::Line, 2> lines;
  for (std::size_t i = 0; i < 2; ++i) {
    fixation.line[i] = look_along(table, eyes[i], viewing, gaze[i]);
    lines[i] = {fixation.line[i].start, fixation.line[i].direction};
  }
  if (distance) {
    fixation.distance = *distance;
  } else {
    // What lies along the mean of both lines, then along each.
    const tracking::Line mean{0.5 * (lines[0].origin + lines[1].origin),
                              glm::normalize(lines[0].direction + lines[1].direction)};
    std::vector<double> seen;
    for (const tracking::Line& line : {mean, lines[0], lines[1]}) {
      const auto along = scene(line.origin, line.direction);
      seen.push_back(along ? dioptres(glm::length(line.origin + *along * line.direction - middle)) : 0.0);
    }
    const auto vergence = tracking::vergence_estimate(lines[0], lines[1], direction_noise);
    const double q = tracking::fixation_distance(seen, vergence).dioptres;
    fixation.distance = q > 0.0 ? 1.0 / q : std::numeric_limits<double>::infinity();
  }
  for (LineOfSight& line : fixation.line) {
    line.point = line.start + along_to(line.start, line.direction, middle, fixation.distance) * line.direction;
  }
  accommodate(fixation, table, eyes, viewing);
  return fixation;
}

Fixation look(const lenses::f64::Table& table, const std::array<EyeOptics, 2>& eyes, Viewing viewing,
              const tracking::LookRequest& request, double direction_noise, const SceneAlong& scene) {
  if (request.two_lines) {
    return fixate_each(table, eyes, viewing, request.gaze, direction_noise, scene, request.distance);
  }
  return fixate_combined(table, eyes, viewing, request.world_from_head, {request.origin, request.gaze[0]}, scene,
                         request.distance);
}

tracking::LookedAt looked_at(const Fixation& fixation) {
  return {{fixation.line[0].gaze, fixation.line[1].gaze}, fixation.distance, fixation.demand};
}

}  // namespace render
