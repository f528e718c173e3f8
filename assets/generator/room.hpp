// The empty room: walls with two windows and a door, floor, ceiling, trim, curtains.
#pragma once

#include <span>

#include "assets/generator/palette.hpp"

namespace assets {

// Inner faces of walls, floor and ceiling, metres.
inline constexpr Box kRoom{{-3.2, 0.0, -4.05}, {3.2, 2.6, 1.9}};

// An opening in a wall; across runs along x in the front wall and along z in the left one.
struct Opening {
  double across_low, across_high, up_low, up_high;
};
// The window with the view, in the front wall, and the one that lets the sun in, in the left wall.
inline constexpr Opening kViewWindow{-2.9, -1.1, 0.85, 2.25};
inline constexpr Opening kSunWindow{-2.1, -0.6, 0.85, 2.15};
inline constexpr double kWallThickness = 0.22;

void add_room(SceneModel& scene, const Palette& palette);

}  // namespace assets
