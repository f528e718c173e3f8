// How far blur reaches: the band around a running picture in which it gathers what the picture itself does not show.
#pragma once

#include "render/fixation.hpp"
#include "render/view_setup.hpp"

namespace render {

// The largest semi-axis of blur (rad) straight ahead that an eye can see between `nearest` (m) and infinity, whatever
// its accommodation does.
[[nodiscard]] double largest_blur(const lenses::f64::Table& table, const EyeOptics& eye, Viewing viewing,
                                  double nearest);

// The same in pixels, rounded up, where a view of width x height has most pixels to the radian, which is at its border;
// never more than an eighth of the shorter side, as a blur that wide leaves little to see at the border anyway.
[[nodiscard]] int guard_pixels(double blur_rad, const tracking::FieldOfView& fov, int width, int height);

}  // namespace render
