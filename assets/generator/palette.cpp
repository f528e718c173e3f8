#include "assets/generator/palette.hpp"

#include "assets/generator/pictures.hpp"
#include "assets/generator/room.hpp"

namespace assets {
namespace {

MaterialId plain(SceneModel& scene, std::string name, const glm::dvec3& colour) {
  return scene.add(Material{.name = std::move(name), .base_colour = colour});
}
MaterialId sheet(SceneModel& scene, std::string name, const glm::dvec3& colour) {
  return scene.add(Material{.name = std::move(name), .base_colour = colour, .double_sided = true});
}
MaterialId glowing(SceneModel& scene, std::string name, const glm::dvec3& colour, const glm::dvec3& emission) {
  return scene.add(Material{.name = std::move(name), .base_colour = colour, .emission = emission});
}

void add_room_materials(SceneModel& scene, Palette& p) {
  p.plaster = scene.add(plaster_picture(512, 256));
  p.ceiling = plain(scene, "ceiling_white", {0.82, 0.81, 0.79});
  p.floor = scene.add(floor_picture(1024, 1024, kRoom.high.x - kRoom.low.x, kRoom.high.z - kRoom.low.z));
  p.trim = plain(scene, "trim_white", {0.86, 0.85, 0.83});
  p.door = plain(scene, "door_green", {0.20, 0.32, 0.27});
  p.metal = plain(scene, "brass", {0.55, 0.42, 0.18});
  p.rug = scene.add(rug_picture(768, 512));
  p.curtain = sheet(scene, "curtain_linen", {0.62, 0.50, 0.34});
}

void add_furniture_materials(SceneModel& scene, Palette& p) {
  p.wood = scene.add(wood_picture(512));
  p.dark_wood = plain(scene, "dark_wood", {0.12, 0.060, 0.030});
  p.cushion = plain(scene, "cushion_teal", {0.08, 0.26, 0.28});
  p.fabric = plain(scene, "armchair_grey", {0.30, 0.29, 0.28});
  p.ceramic = plain(scene, "ceramic_blue", {0.12, 0.22, 0.42});
  p.soil = plain(scene, "soil", {0.06, 0.04, 0.03});
  p.leaf = sheet(scene, "houseplant_leaf", {0.07, 0.28, 0.06});
  p.stem = plain(scene, "houseplant_stem", {0.20, 0.28, 0.08});
  p.painting_bay = scene.add(bay_picture(384, 256));
  p.painting_evening = scene.add(evening_picture(256, 320));
  p.book_paper = plain(scene, "book_paper", {0.78, 0.73, 0.62});
  constexpr std::array<glm::dvec3, 8> kCovers{{{0.45, 0.06, 0.05},
                                               {0.07, 0.14, 0.35},
                                               {0.06, 0.24, 0.12},
                                               {0.55, 0.36, 0.07},
                                               {0.25, 0.09, 0.22},
                                               {0.60, 0.55, 0.45},
                                               {0.05, 0.05, 0.06},
                                               {0.50, 0.20, 0.06}}};
  for (std::size_t i = 0; i < kCovers.size(); ++i)
    p.books[i] = plain(scene, "book_cover_" + std::to_string(i + 1), kCovers[i]);
}

void add_shining_materials(SceneModel& scene, Palette& p) {
  p.shade_glow = scene.add(Material{.name = "lampshade_paper",
                                    .base_colour = {0.30, 0.26, 0.20},
                                    .emission = {0.70, 0.56, 0.36},
                                    .double_sided = true});
  p.pendant_outside = plain(scene, "pendant_enamel", {0.12, 0.20, 0.20});
  p.pendant_inside = glowing(scene, "pendant_inside", {0.5, 0.48, 0.44}, {0.55, 0.48, 0.38});
  p.bulb = glowing(scene, "bulb", {0.0, 0.0, 0.0}, {3.0, 2.6, 2.0});
  const MaterialId screen_case = plain(scene, "screen_case", {0.03, 0.03, 0.035});
  const MaterialId phone_case = plain(scene, "phone_case", {0.02, 0.025, 0.04});
  p.screen = {glowing(scene, "screen_page", {0.02, 0.02, 0.02}, {0.88, 0.89, 0.90}),
              plain(scene, "screen_text", {0.02, 0.02, 0.02}),
              glowing(scene, "screen_bar", {0.02, 0.02, 0.02}, {0.45, 0.62, 0.80}), screen_case};
  p.phone = {glowing(scene, "phone_page", {0.02, 0.02, 0.02}, {0.84, 0.87, 0.84}),
             plain(scene, "phone_text", {0.02, 0.02, 0.02}),
             glowing(scene, "phone_bar", {0.02, 0.02, 0.02}, {0.40, 0.66, 0.55}), phone_case};
}

void add_chart_materials(SceneModel& scene, Palette& p) {
  p.chart = {plain(scene, "chart_paper", {0.92, 0.92, 0.91}), plain(scene, "chart_ink", {0.015, 0.015, 0.015}),
             p.dark_wood};
  p.card = {plain(scene, "card_paper", {0.92, 0.91, 0.88}), plain(scene, "card_ink", {0.015, 0.015, 0.015}), p.ceramic};
}

void add_outdoor_materials(SceneModel& scene, Palette& p) {
  p.bark = plain(scene, "bark", {0.16, 0.11, 0.07});
  p.foliage = sheet(scene, "foliage", {0.10, 0.25, 0.05});
  p.foliage_light = sheet(scene, "foliage_light", {0.17, 0.33, 0.07});
  p.sign_board = plain(scene, "sign_board", {0.80, 0.79, 0.72});
  p.sign_ink = plain(scene, "sign_ink", {0.02, 0.05, 0.03});
  p.house_wall = plain(scene, "house_wall", {0.66, 0.58, 0.45});
  p.house_roof = plain(scene, "house_roof", {0.38, 0.13, 0.08});
  p.house_window = plain(scene, "house_window", {0.05, 0.07, 0.10});
  p.house_door = plain(scene, "house_door", {0.08, 0.16, 0.28});
  p.path = plain(scene, "gravel", {0.45, 0.40, 0.32});
  constexpr std::array<glm::dvec3, 4> kFields{
      {{0.14, 0.27, 0.06}, {0.18, 0.30, 0.08}, {0.32, 0.33, 0.10}, {0.10, 0.22, 0.06}}};
  for (std::size_t i = 0; i < kFields.size(); ++i)
    p.fields[i] = plain(scene, "field_" + std::to_string(i + 1), kFields[i]);
  constexpr std::array<glm::dvec3, 3> kHills{{{0.16, 0.24, 0.20}, {0.22, 0.30, 0.34}, {0.32, 0.40, 0.48}}};
  for (std::size_t i = 0; i < kHills.size(); ++i)
    p.hills[i] = plain(scene, "hills_" + std::to_string(i + 1), kHills[i]);
}

}  // namespace

Palette make_palette(SceneModel& scene) {
  Palette palette{};
  add_room_materials(scene, palette);
  add_furniture_materials(scene, palette);
  add_shining_materials(scene, palette);
  add_chart_materials(scene, palette);
  add_outdoor_materials(scene, palette);
  return palette;
}

}  // namespace assets
