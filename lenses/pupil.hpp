// The pupil's diameter by light and age.
#pragma once

namespace lenses {

// Watson and Yellott 2012, unified formula: luminance (cd/m2) of a field of area_deg2 square degrees seen by one or
// both eyes, age in years (the formula's data end at 83). Returns metres.
[[nodiscard]] double pupil_diameter_in_light(double luminance, double area_deg2, bool both_eyes, double age);

}  // namespace lenses
