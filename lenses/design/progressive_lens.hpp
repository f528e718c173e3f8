// A finished progressive lens of spherical distance power: the designed surface on one face, a sphere on the other,
// both solved for so that a lensmeter reads the order.
#pragma once

#include <optional>

#include "lenses/design/progressive.hpp"

namespace lenses {

struct ProgressiveLensRequest {
  // As the surface is to be; its powers and, unless given, its diameter follow from the order.
  ProgressiveConfig surface;
  double sphere = 0.0, addition = 2.0;               // ordered, D
  std::optional<double> base_curve;                  // front power at the distance point, D; absent: Vogel's rule
  std::optional<double> diameter, centre_thickness;  // m; absent: by rule
  double minimum_centre_thickness = 0.0012, minimum_edge_thickness = 0.001;  // m
  double abbe = 58.0;
  Fit fit{.vertex_distance = 0.013, .pantoscopic_tilt = 8.0 * 0.017453292519943295, .wrap = 5.0 * 0.017453292519943295};

  // Throws tracking::InputError whose field is the member's name here or in ProgressiveConfig.
  void validate() const;
};

struct ProgressiveLens {
  Lens lens;  // lens.order is set
  ProgressiveReport report;
  double base_curve = 0.0;  // D
  // As a lensmeter reads them, mean of both meridians: distance with the back on its stop, the addition with the
  // progressive's side there; D.
  double distance_reading = 0.0, addition_reading = 0.0;
  double thinnest_edge = 0.0, thickest_edge = 0.0;  // m
};

// Throws as validate() does, also where no such lens can be made.
[[nodiscard]] ProgressiveLens make_progressive_lens(const ProgressiveLensRequest& request,
                                                    const DesignProgress& progress = nullptr);

}  // namespace lenses
