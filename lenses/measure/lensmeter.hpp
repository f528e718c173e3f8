// A focimeter (ISO 8598) on the double-precision tracer. The lens stands with one of its surfaces on the lens stop, so
// that the beam is normal to that surface at the point under test; the light on the lens's other side is collimated.
//
// With the back surface on the stop it reads back vertex power, with the front surface front vertex power: the addition
// of a progressive or a bifocal is read from the side that carries it.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "lenses/lens.hpp"
#include "lenses/lens_model.hpp"
#include "lenses/trace_result.hpp"

namespace lenses {

enum class LensSide { back, front };

// Nothing but status means anything unless it is ok.
struct LensmeterReading {
  RayStatus status = RayStatus::miss_back;
  // Vertex power in the plane across the beam (hh, hv, vv in D); horizontal is e_h = normalize(d x y) for the beam's
  // direction d towards the scene.
  glm::dvec3 power{0.0};
  // Deviation between the beam's directions on both sides of the lens, 100 tan(angle), towards the base; to the
  // wearer's right and up in the same plane. Prism dioptres.
  glm::dvec2 prism{0.0};
  glm::dvec2 far_point{0.0};  // where the beam meets the other surface, lens axes, m
  int zone = 0;               // see zone_of
};

class Lensmeter {
 public:
  // Throws std::invalid_argument for a lens that cannot be modelled (see append_lens).
  explicit Lensmeter(const Lens& lens);

  // At a point of the lens (lens axes, m): where the surface on the stop has this x and y.
  [[nodiscard]] LensmeterReading read(LensSide side, const glm::dvec2& point) const;

  // Glass along the lens axis; none where a surface ends. Negative where the surfaces have crossed.
  [[nodiscard]] std::optional<double> thickness(const glm::dvec2& point) const;

  // (index - 1) times the mean curvature, D; positive where a surface makes light converge. None where it ends.
  [[nodiscard]] std::optional<double> surface_power(LensSide side, const glm::dvec2& point) const;

 private:
  [[nodiscard]] f64::SurfacePoint point_on(LensSide side, const glm::dvec2& point) const;
  [[nodiscard]] bool within(const glm::dvec2& point) const;
  [[nodiscard]] LensmeterReading read_back(const glm::dvec2& point) const;
  [[nodiscard]] LensmeterReading read_front(const glm::dvec2& point) const;

  // From path.front_hit against the beam to the back surface: fills back_hit, back and t_front.
  bool meet_back_from_inside(f64::LensPath& path, const glm::dvec3& beam) const;

  LensModel model_;
};

}  // namespace lenses
