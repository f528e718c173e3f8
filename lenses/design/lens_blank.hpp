// What a lens is before its surfaces are known: glass, fit, reference points, and the power it is to have.
#pragma once

#include "lenses/design/lens_request.hpp"
#include "lenses/design/ordered_power.hpp"
#include "lenses/lens.hpp"

namespace lenses::design {

inline constexpr double kFittingCross = 0.004, kDistancePoint = 0.008;  // y on a progressive lens, m

[[nodiscard]] Lens blank_lens(const LensRequest& request);

// The order, prism thinning included.
[[nodiscard]] PointPower order_of(const LensRequest& request);

[[nodiscard]] double mean_power(const PointPower& power);

}  // namespace lenses::design
