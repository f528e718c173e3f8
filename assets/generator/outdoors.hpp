// What is seen through the windows: sun, ground, a tree and a sign at 10 m, a house at 50 m, hills beyond 10 km.
#pragma once

#include "assets/generator/font.hpp"
#include "assets/generator/palette.hpp"

namespace assets {

inline constexpr double kGround = -0.4;  // m, below the room's floor

void add_outdoors(SceneModel& scene, const Palette& palette, const Font& font);

}  // namespace assets
