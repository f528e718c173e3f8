// A lens in the making: its surfaces as functions of a point of the lens plane, in double precision, quick to change
// one at a time.
#pragma once

#include <memory>
#include <optional>

#include "lenses/design/ordered_power.hpp"
#include "lenses/engine.hpp"
#include "lenses/lens.hpp"

namespace lenses::design {

// One surface where its placement puts it; z without the lens's thickness. Copies share what was prepared.
class PlacedSurface {
 public:
  PlacedSurface(const Surface& surface, const Placement& placement);

  [[nodiscard]] f64::SurfacePoint at(const glm::dvec2& xy) const;
  void place(const Placement& placement) { placement_ = placement; }

 private:
  struct Prepared;
  std::shared_ptr<const Prepared> prepared_;
  Placement placement_;
};

// Keeps a lens and its prepared surfaces in step.
class LensShape {
 public:
  explicit LensShape(Lens lens);

  [[nodiscard]] const Lens& lens() const { return lens_; }
  // Heights in lens axes: the origin is the back vertex.
  [[nodiscard]] f64::SurfacePoint front(const glm::dvec2& xy) const;
  [[nodiscard]] f64::SurfacePoint back(const glm::dvec2& xy) const { return back_.at(xy); }
  // Glass along the lens axis; none where a surface ends, negative where they have crossed.
  [[nodiscard]] std::optional<double> thickness(const glm::dvec2& xy) const;

  void set_front(Surface surface);
  void set_back(Surface surface);
  void place_front(const Placement& placement);
  void place_back(const Placement& placement);
  void set_thickness(double thickness) { lens_.centre_thickness = thickness; }
  Lens& rest() { return lens_; }  // what is neither a surface nor its placement

 private:
  Lens lens_;
  PlacedSurface front_, back_;
};

// What a lensmeter reads with the back (or the front) surface on its stop, the beam normal to that surface at the
// point: vertex power and prism. None where the beam does not pass.
[[nodiscard]] std::optional<PointPower> reading_at_back(const LensShape& lens, const glm::dvec2& point);
[[nodiscard]] std::optional<PointPower> reading_at_front(const LensShape& lens, const glm::dvec2& point);

}  // namespace lenses::design
