// What the person inside the headset should know before and while looking: their own eyes, the display's distance, and
// what the simulated spectacles ask of a pair of eyes.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "lenses/headset.hpp"
#include "lenses/lens.hpp"

namespace lenses {

struct Finding {
  std::string code;          // "own_blur", "convergence", "pupillary_distance", "vertical_prism"
  std::optional<Side> side;  // absent: both eyes together
  double value = 0.0;
  std::string unit;
  std::string message;  // one sentence for people
};

// Residual of the viewer's own eye that looks at the headset's virtual image, at the pupil, after the accommodation
// that best focuses it: hh, hv, vv (D). What is worn in the headset is taken to correct the refraction in full.
[[nodiscard]] glm::dvec3 viewer_residual(const Viewer& viewer, double age, double focal_distance);

// own_blur: a residual above 0.25 D in a meridian (value: the worst meridian's, D). convergence: the viewer is younger
// than 45, so that converging may pull the eye's focus off the display's plane (value: years). Only of the eyes whose
// viewer the wearer file names.
[[nodiscard]] std::vector<Finding> viewer_findings(const Wearer& wearer, const HeadsetDisplay& headset);

// pupillary_distance: the headset's lenses (m apart) and the wearer's differ by more than 1 mm (value: mm, the
// headset's less the wearer's). The message has the prism that follows by Prentice's rule from horizontal_power (D, of
// the worn lenses, indexed by Side; 0 without).
[[nodiscard]] std::optional<Finding> distance_finding(const Wearer& wearer, double headset_distance,
                                                      const std::array<double, 2>& horizontal_power);

// One eye's line of sight on either side of its lens, head axes, any length.
struct SightDirections {
  glm::dvec3 gaze;    // before the lens
  glm::dvec3 object;  // beyond it
};

// Prism dioptres, base up positive: the lens turns the line of sight, on its way to the object, towards the base; 100
// tan of the difference of the elevations.
[[nodiscard]] double vertical_prism(const SightDirections& sight);

// vertical_prism: the eyes' vertical prisms differ by more than 1 prism dioptre (value: right less left).
[[nodiscard]] std::optional<Finding> vertical_prism_finding(const std::array<SightDirections, 2>& sight);

}  // namespace lenses
