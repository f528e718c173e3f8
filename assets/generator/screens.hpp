// What shines on the table: the monitor and the phone, each as a node in the frame of its picture (middle at the
// origin, z toward the eyes).
#pragma once

#include "assets/generator/font.hpp"
#include "assets/generator/scene_model.hpp"

namespace assets {

struct ScreenMaterials {
  MaterialId page, text, bar, case_colour;
};

// 16:9, 0.36 m wide: a page of text and Landolt rings of logMAR 0.6 to 0.1 for the given distance.
[[nodiscard]] Node monitor(const ScreenMaterials& materials, const Font& font, double distance);
[[nodiscard]] Node phone(const ScreenMaterials& materials, const Font& font);

}  // namespace assets
