// What stands and hangs in the room, lamps included.
#pragma once

#include "assets/generator/palette.hpp"

namespace assets {

inline constexpr double kTableTop = 0.74;  // m

void add_table(SceneModel& scene, const Palette& palette);
// Small things on the table, and the stands that hold card, phone and monitor.
void add_table_things(SceneModel& scene, const Palette& palette);
void add_bookshelf(SceneModel& scene, const Palette& palette);
// A low cabinet under the charts, an armchair in the sun, paintings, a plant.
void add_cabinet(SceneModel& scene, const Palette& palette);
void add_armchair(SceneModel& scene, const Palette& palette);
void add_paintings(SceneModel& scene, const Palette& palette);
void add_plant(SceneModel& scene, const Palette& palette);
// The pendant above the table and the standing lamp in the corner, with a point light each.
void add_lamps(SceneModel& scene, const Palette& palette);

}  // namespace assets
