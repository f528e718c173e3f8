#include <array>

#include "assets/generator/furniture.hpp"
#include "assets/generator/room.hpp"

namespace assets {

void add_lamps(SceneModel& scene, const Palette& p) {
  constexpr glm::dvec3 kPendant(0.5, 2.12, -0.6), kStanding(1.50, 1.52, -3.40);
  Node pendant{.name = "pendant"};
  // Open below; its enamel keeps the light off the ceiling, where it would be far too bright.
  constexpr std::array<glm::dvec2, 5> kOutside{{{0.24, 0.0}, {0.19, 0.10}, {0.10, 0.17}, {0.03, 0.20}, {0.0, 0.20}}};
  constexpr std::array<glm::dvec2, 4> kInside{{{0.0, 0.19}, {0.095, 0.165}, {0.185, 0.097}, {0.236, 0.0}}};
  add_lathe(pendant.in(p.pendant_outside), kPendant, kOutside, 72, Profile::smooth);
  add_lathe(pendant.in(p.pendant_inside), kPendant, kInside, 72, Profile::smooth);
  add_sphere(pendant.in(p.bulb), kPendant + glm::dvec3(0.0, 0.06, 0.0), 0.035, 32);
  add_bar(pendant.in(p.dark_wood), kPendant + glm::dvec3(0.0, 0.19, 0.0), {kPendant.x, kRoom.high.y, kPendant.z}, 0.004,
          0.004, 12);
  scene.nodes.push_back(std::move(pendant));
  scene.nodes.push_back(Node{.name = "pendant_light",
                             .translation = kPendant + glm::dvec3(0.0, 0.005, 0.0),
                             .light = Light{Light::Type::point, {1.0, 0.93, 0.82}, 3.6}});

  Node standing{.name = "standing_lamp"};
  constexpr std::array<glm::dvec2, 4> kFoot{{{0.0, 0.0}, {0.15, 0.0}, {0.14, 0.02}, {0.02, 0.035}}};
  add_lathe(standing.in(p.metal), {kStanding.x, 0.0, kStanding.z}, kFoot, 56);
  add_bar(standing.in(p.metal), {kStanding.x, 0.03, kStanding.z}, kStanding, 0.011, 0.011, 24);
  constexpr std::array<glm::dvec2, 2> kShade{{{0.17, -0.14}, {0.13, 0.14}}};
  add_lathe(standing.in(p.shade_glow), kStanding, kShade, 72);
  scene.nodes.push_back(std::move(standing));
  // The shade is open above and below; a tracer's shadow rays end at its paper, which shines by its own emission.
  scene.nodes.push_back(Node{.name = "standing_lamp_light",
                             .translation = kStanding + glm::dvec3(0.0, 0.04, 0.0),
                             .light = Light{Light::Type::point, {1.0, 0.84, 0.62}, 0.9}});
}

}  // namespace assets
