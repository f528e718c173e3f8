// Every material of the reading room, by name.
#pragma once

#include "assets/generator/charts.hpp"
#include "assets/generator/scene_model.hpp"
#include "assets/generator/screens.hpp"

namespace assets {

struct Palette {
  // room
  MaterialId plaster, ceiling, floor, trim, door, metal, rug, curtain;
  // furniture
  MaterialId wood, dark_wood, cushion, fabric, ceramic, soil, leaf, stem, painting_bay, painting_evening, book_paper;
  std::array<MaterialId, 8> books;
  // what shines
  MaterialId shade_glow, pendant_outside, pendant_inside, bulb;
  // charts and screens
  ChartMaterials chart, card;
  ScreenMaterials screen, phone;
  // outdoors
  MaterialId bark, foliage, foliage_light, sign_board, sign_ink, house_wall, house_roof, house_window, house_door, path;
  std::array<MaterialId, 4> fields;
  std::array<MaterialId, 3> hills;
};

[[nodiscard]] Palette make_palette(SceneModel& scene);

}  // namespace assets
