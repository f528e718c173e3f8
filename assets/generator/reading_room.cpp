#include "assets/generator/reading_room.hpp"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "assets/generator/charts.hpp"
#include "assets/generator/furniture.hpp"
#include "assets/generator/outdoors.hpp"
#include "assets/generator/room.hpp"
#include "assets/generator/screens.hpp"

namespace assets {
namespace {

// A node whose own frame is a sheet's: put at its place, turned to the eyes, and made a target.
void add_facing(SceneModel& scene, Node node, const Placement& placement) {
  node.translation = placement.position();
  node.rotation = placement.facing();
  node.target = true;
  scene.nodes.push_back(std::move(node));
}

void add_point_target(SceneModel& scene, std::string name, const glm::dvec3& position) {
  scene.nodes.push_back(Node{.name = std::move(name), .translation = position, .target = true});
}

}  // namespace

glm::dvec3 Placement::position() const {
  const double right = glm::radians(right_deg), up = glm::radians(up_deg);
  return kEyes + distance * glm::dvec3(std::cos(up) * std::sin(right), std::sin(up), -std::cos(up) * std::cos(right));
}

glm::dquat Placement::facing() const {
  return glm::angleAxis(-glm::radians(right_deg), glm::dvec3(0.0, 1.0, 0.0)) *
         glm::angleAxis(glm::radians(up_deg), glm::dvec3(1.0, 0.0, 0.0));
}

SceneModel make_reading_room(const std::string& font_path) {
  const Font font(font_path);
  SceneModel scene;
  const Palette palette = make_palette(scene);
  scene.nodes.push_back(Node{.name = "start", .translation = kEyes, .camera = true});
  add_room(scene, palette);
  add_table(scene, palette);
  add_table_things(scene, palette);
  add_bookshelf(scene, palette);
  add_cabinet(scene, palette);
  add_armchair(scene, palette);
  add_paintings(scene, palette);
  add_plant(scene, palette);
  add_lamps(scene, palette);
  add_outdoors(scene, palette, font);
  add_facing(scene, near_card(palette.card, font), kNearCard);
  add_facing(scene, phone(palette.phone, font), kPhone);
  add_facing(scene, monitor(palette.screen, font, kScreen.distance), kScreen);
  add_facing(scene, etdrs_chart(palette.chart, kEtdrsChart.distance), kEtdrsChart);
  add_facing(scene, clock_dial(palette.chart, font), kClockDial);
  const Opening& w = kViewWindow;
  // Off the mullions: the middle of the middle pane.
  add_point_target(scene, "window", {0.5 * (w.across_low + w.across_high), 0.5 * (w.up_low + w.up_high), kRoom.low.z});
  add_point_target(scene, "house_50m", kHouse.position());
  add_point_target(scene, "horizon", kHorizon.position());
  return scene;
}

}  // namespace assets
