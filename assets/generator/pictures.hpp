// The procedural pictures (textures) of the room, from value noise with a fixed seed: the same bytes on every machine
// that rounds alike.
#pragma once

#include "assets/generator/scene_model.hpp"

namespace assets {

[[nodiscard]] Picture wood_picture(int size);
// Boards across a floor of the given size in metres, darker toward the walls as a room's floor is.
[[nodiscard]] Picture floor_picture(int width, int height, double metres_x, double metres_z);
// Plaster, darker toward floor, ceiling and corners.
[[nodiscard]] Picture plaster_picture(int width, int height);
// A rug with a border and a lozenge pattern of woven threads.
[[nodiscard]] Picture rug_picture(int width, int height);
// Two paintings: a bay with a sail, and hills at evening.
[[nodiscard]] Picture bay_picture(int width, int height);
[[nodiscard]] Picture evening_picture(int width, int height);

}  // namespace assets
