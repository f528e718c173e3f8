#include "render/scene/ray_query.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <stdexcept>
#include <vector>

#include "render/scene/cut_out.hpp"
#include "render/scene/embree_device.hpp"

namespace render {

struct RayQuery::State {
  EmbreeDevice device;
  EmbreeScene scene;
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;
  std::vector<bool> single_sided, clear;  // of each triangle
  std::vector<std::uint32_t> cut_out;     // those of cut-out materials, ascending
  std::optional<CutOuts> holes;           // in cut_out's order

  [[nodiscard]] bool is_hole(std::uint32_t triangle, float u, float v) const {
    const auto found = std::ranges::lower_bound(cut_out, triangle);
    return found != cut_out.end() && *found == triangle &&
           holes->is_hole(static_cast<std::uint32_t>(found - cut_out.begin()), u, v);
  }

  // hit: of a unit direction.
  [[nodiscard]] bool is_passed(const glm::dvec3& direction, const RTCHit& hit) const {
    const std::uint32_t triangle = hit.primID;
    if (clear[triangle] || is_hole(triangle, hit.u, hit.v)) return true;
    const glm::uvec3 index = triangles[triangle];
    const glm::dvec3 v0(positions[index.x]);
    const glm::dvec3 normal = glm::cross(glm::dvec3(positions[index.y]) - v0, glm::dvec3(positions[index.z]) - v0);
    return single_sided[triangle] && glm::dot(normal, direction) > 0.0;
  }

  // The first hit from either side.
  [[nodiscard]] std::optional<RTCRayHit> closest(const glm::dvec3& origin, const glm::dvec3& unit) const;

  // Distance along a unit direction to the triangle's plane, in double precision: Embree's float distance is only good
  // to 1e-7 of the coordinates. Its own value where the ray lies almost in the plane.
  [[nodiscard]] double refine(const glm::dvec3& origin, const glm::dvec3& direction, std::uint32_t triangle,
                              double rough) const {
    const glm::uvec3 index = triangles[triangle];
    const glm::dvec3 v0(positions[index.x]);
    const glm::dvec3 normal = glm::cross(glm::dvec3(positions[index.y]) - v0, glm::dvec3(positions[index.z]) - v0);
    const double slope = glm::dot(normal, direction);
    const double distance = glm::dot(normal, v0 - origin) / slope;
    const bool steep = std::abs(slope) > 1e-6 * glm::length(normal);
    return steep && std::isfinite(distance) ? std::max(distance, 0.0) : rough;
  }
};

RayQuery::RayQuery(const Scene& scene) : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.positions.reserve(scene.vertices.size());
  for (const Vertex& vertex : scene.vertices) s.positions.push_back(vertex.position);
  s.triangles = scene.triangles;
  for (std::size_t i = 0; i < scene.triangle_material.size(); ++i) {
    const Material& material = scene.materials.at(scene.triangle_material[i]);
    if (material.alpha == Material::Alpha::mask) s.cut_out.push_back(static_cast<std::uint32_t>(i));
    s.single_sided.push_back(!material.double_sided);
    s.clear.push_back(material.alpha == Material::Alpha::blend && material.base_colour.a < 0.5F);
  }
  s.holes.emplace(scene, s.cut_out);
  s.device = make_embree_device();
  s.scene.reset(rtcNewScene(s.device.get()));
  rtcSetSceneFlags(s.scene.get(), RTC_SCENE_FLAG_ROBUST);

  const EmbreeGeometry geometry(rtcNewGeometry(s.device.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
  auto* vertices = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
      geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), s.positions.size()));
  auto* indices = static_cast<glm::uvec3*>(rtcSetNewGeometryBuffer(
      geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3), s.triangles.size()));
  check_embree(s.device.get(), "rtcSetNewGeometryBuffer");
  if (!s.positions.empty()) std::copy(s.positions.begin(), s.positions.end(), vertices);
  if (!s.triangles.empty()) std::copy(s.triangles.begin(), s.triangles.end(), indices);
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometry(s.scene.get(), geometry.get());
  rtcCommitScene(s.scene.get());
  check_embree(s.device.get(), "rtcCommitScene");
}

RayQuery::~RayQuery() = default;
RayQuery::RayQuery(RayQuery&&) noexcept = default;
RayQuery& RayQuery::operator=(RayQuery&&) noexcept = default;

std::optional<RTCRayHit> RayQuery::State::closest(const glm::dvec3& origin, const glm::dvec3& unit) const {
  // Embree's coordinates end at 1.8e18.
  const bool near = std::abs(origin.x) < 1e18 && std::abs(origin.y) < 1e18 && std::abs(origin.z) < 1e18;
  if (!near || !(glm::dot(unit, unit) > 0.5)) return std::nullopt;  // no direction, or too long a one
  const glm::vec3 o(origin), d(unit);
  RTCRayHit ray{};
  ray.ray.org_x = o.x;
  ray.ray.org_y = o.y;
  ray.ray.org_z = o.z;
  ray.ray.dir_x = d.x;
  ray.ray.dir_y = d.y;
  ray.ray.dir_z = d.z;
  ray.ray.tfar = std::numeric_limits<float>::infinity();
  ray.ray.mask = 0xFFFFFFFFU;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  intersect_one(scene.get(), ray);
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return ray;
}

std::optional<RayQuery::Hit> RayQuery::closest(glm::dvec3 origin, glm::dvec3 direction) const {
  const glm::dvec3 unit = direction / glm::length(direction);
  const auto ray = state_->closest(origin, unit);
  if (!ray) return std::nullopt;
  return Hit{state_->refine(origin, unit, ray->hit.primID, static_cast<double>(ray->ray.tfar)), ray->hit.primID};
}

std::optional<RayQuery::Hit> RayQuery::looked_at(glm::dvec3 origin, glm::dvec3 direction) const {
  constexpr int kMostPassed = 64;
  double before = 0.0;
  const glm::dvec3 unit = direction / glm::length(direction);
  for (int i = 0; i < kMostPassed; ++i) {
    const auto ray = state_->closest(origin, unit);
    if (!ray) return std::nullopt;
    const double distance = state_->refine(origin, unit, ray->hit.primID, static_cast<double>(ray->ray.tfar));
    if (!state_->is_passed(unit, ray->hit)) return Hit{before + distance, ray->hit.primID};
    // On by more than the rounding of Embree's coordinates.
    const glm::dvec3 at = origin + distance * unit;
    const double on = distance + 1e-5 + 2e-6 * std::max({std::abs(at.x), std::abs(at.y), std::abs(at.z)});
    origin += on * unit;
    before += on;
  }
  return std::nullopt;
}

}  // namespace render
