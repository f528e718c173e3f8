// A lens made from a prescription: the surfaces are solved for so that a lensmeter reads the order, or so that the eye
// behind the worn lens gets it.
#pragma once

#include <optional>

#include "lenses/design/lens_request.hpp"
#include "lenses/lens.hpp"

namespace lenses {

struct DesignedLens {
  Lens lens;                  // lens.order is set
  Prescription verification;  // what a lensmeter reads at the reference points
  // What the eye gets, referred to the refraction's vertex; none where it does not see through the lens in this fit.
  std::optional<Prescription> worn;
  double base_curve = 0.0;                          // D
  double thinnest_edge = 0.0, thickest_edge = 0.0;  // m, over the outline
  double volume = 0.0;                              // m^3, within the outline
};

// Throws DesignError where the lens cannot be made.
[[nodiscard]] DesignedLens design_lens(const LensRequest& request);

}  // namespace lenses
