// Progressive surfaces: power that rises down a corridor from the distance to the near zone, as a bicubic B-spline.
// Wearer's axes (a right lens has its near zone toward -x). Height and slope are zero at the lens centre, so that the
// surface adds no prism there. Powers are of this one surface: (n - 1) times its curvature on the front, (1 - n) on the
// eye side.
#pragma once

#include <array>
#include <functional>
#include <optional>

#include "lenses/design/progressive_family.hpp"
#include "lenses/lens.hpp"

namespace lenses {

struct ProgressiveConfig {
  enum class Method { closed_form, variational };
  enum class Face { front, eye_side };
  static constexpr double kNetMargin = 0.003;  // m
  // Of a surface, D: beyond what may be ordered, as through a strong lens a lensmeter reads not quite the surface's
  // own.
  static constexpr double kLeastAddition = 0.5, kMostAddition = 5.0;
  Method method = Method::variational;
  Face face = Face::front;  // which side of the lens carries the surface
  Side side = Side::right;
  double distance_power = 5.0;     // of this surface, D; eye side: usually negative
  double addition = 2.0;           // D
  double corridor_length = 0.014;  // from the fitting cross down to the near point, m
  double inset = 0.0025;           // near point toward the nose, m
  double hardness = 0.5;           // 0: soft, blur spread wide and low .. 1: hard, wide clear zones. Variational only
  double index = 1.6;
  double diameter = 0.065;        // of the lens, m; the net reaches kNetMargin beyond
  double fitting_cross = 0.004;   // y, m
  double distance_point = 0.008;  // y, m
  std::size_t grid = 50;          // control points along each axis

  // Throws tracking::InputError whose field is the member's name.
  void validate() const;
  // The largest diameter that surfaces of this power allow, m.
  [[nodiscard]] double widest() const;
  [[nodiscard]] double power_per_curvature() const { return face == Face::front ? index - 1.0 : 1.0 - index; }
  [[nodiscard]] double nose_x() const { return side == Side::right ? -1.0 : 1.0; }
  [[nodiscard]] glm::dvec2 near_point() const { return {nose_x() * inset, fitting_cross - corridor_length}; }
  [[nodiscard]] double half_width() const { return 0.5 * diameter + kNetMargin; }  // of the net's square, m
};

// Width of the zone about the umbilic line where the unwanted cylinder stays below a limit, m.
struct ZoneWidth {
  double limit = 0.0;      // D
  double narrowest = 0.0;  // between fitting cross and near point
  double narrowest_y = 0.0;
  double at_distance = 0.0, at_near = 0.0;  // at the heights of the two points
};

struct ProgressiveReport {
  double distance_power = 0.0, near_power = 0.0;  // mean surface power at the two points, D
  [[nodiscard]] double addition() const { return near_power - distance_power; }
  // From the fitting cross down the umbilic line to where 85 % of the ordered addition is reached, m; 0 if never.
  double corridor_to_85_percent = 0.0;
  std::array<ZoneWidth, 3> widths;  // for 0.25, 0.5 and 1 D
  double peak_cylinder = 0.0;       // within the lens's diameter, D
  glm::dvec2 peak_at{0.0};
  // Minkwitz 1963: beside an umbilic line cylinder grows at twice the rate at which power changes along it. Both rates
  // where power changes fastest, D/m.
  double minkwitz_y = 0.0, minkwitz_bound = 0.0, minkwitz_reached = 0.0;
};

struct ProgressiveDesign {
  BsplineHeightField surface;
  ProgressiveReport report;
};

// Of a design under way, 0..1.
using DesignProgress = std::function<void(double)>;

// The sphere family with a configuration's layout, in its own coordinates.
[[nodiscard]] ProgressiveFamilyConfig family_config(const ProgressiveConfig& config);

[[nodiscard]] BsplineHeightField closed_form_progressive(const ProgressiveConfig& config);

// Throws as validate() does.
[[nodiscard]] ProgressiveDesign design_progressive(const ProgressiveConfig& config,
                                                   const DesignProgress& progress = nullptr);

}  // namespace lenses
