#include "assets/generator/model_scenes.hpp"

#include <array>
#include <glm/ext/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

#include "assets/generator/charts.hpp"
#include "assets/generator/ink.hpp"

namespace assets {
namespace {

constexpr Box kHall{{-6.0, 0.0, -11.5}, {6.0, 3.4, 2.5}};
constexpr Box kStudy{{-2.0, 0.0, -2.5}, {2.0, 2.6, 1.5}};
const std::string kModelPrefix = "model_";  // of the nodes that add_model makes
constexpr double kTableHeight = 0.75, kCrease_deg = 40.0;

struct HallPalette {
  MaterialId wall, ceiling, light_tile, dark_tile, stripe, lamp;
};

HallPalette hall_palette(SceneModel& scene) {
  return {scene.add(Material{.name = "hall wall", .base_colour = {0.72, 0.70, 0.66}}),
          scene.add(Material{.name = "hall ceiling", .base_colour = {0.80, 0.80, 0.80}}),
          scene.add(Material{.name = "light tile", .base_colour = {0.52, 0.51, 0.49}, .roughness = 0.4}),
          scene.add(Material{.name = "dark tile", .base_colour = {0.30, 0.31, 0.33}, .roughness = 0.4}),
          scene.add(Material{.name = "hall stripe", .base_colour = {0.10, 0.16, 0.28}}),
          scene.add(Material{.name = "lamp", .base_colour = {0.9, 0.9, 0.9}, .emission = {4.0, 3.9, 3.7}})};
}

// Walls with a stripe at hand height, a chequered floor and a ceiling: straight lines show what a lens does to them.
void add_hall(SceneModel& scene, const HallPalette& p, const Box& b, double tile) {
  Node node{.name = "hall"};
  const glm::dvec3 l = b.low, h = b.high;
  const std::array<std::array<glm::dvec2, 2>, 4> walls{
      {{{{l.x, l.z}, {h.x, l.z}}}, {{{h.x, l.z}, {h.x, h.z}}}, {{{h.x, h.z}, {l.x, h.z}}}, {{{l.x, h.z}, {l.x, l.z}}}}};
  const std::array<double, 4> heights{l.y, 0.9, 1.1, h.y};
  for (const auto& [from, to] : walls) {
    for (std::size_t i = 0; i + 1 < heights.size(); ++i) {
      add_quad(node.in(i == 1 ? p.stripe : p.wall), {from.x, heights[i], from.y}, {to.x, heights[i], to.y},
               {to.x, heights[i + 1], to.y}, {from.x, heights[i + 1], from.y});
    }
  }
  add_quad(node.in(p.ceiling), {l.x, h.y, l.z}, {h.x, h.y, l.z}, {h.x, h.y, h.z}, {l.x, h.y, h.z});
  const int across = static_cast<int>(std::round((h.x - l.x) / tile)),
            deep = static_cast<int>(std::round((h.z - l.z) / tile));
  for (int i = 0; i < across; ++i) {
    for (int k = 0; k < deep; ++k) {
      const double x = l.x + i * tile, z = l.z + k * tile;
      add_quad(node.in((i + k) % 2 == 0 ? p.light_tile : p.dark_tile), {x, 0.0, z + tile}, {x + tile, 0.0, z + tile},
               {x + tile, 0.0, z}, {x, 0.0, z});
    }
  }
  scene.nodes.push_back(std::move(node));
}

// A flat lamp that hangs from the ceiling and the point of light that stands for it, far enough below the ceiling not
// to glare there.
void add_lamp(SceneModel& scene, const HallPalette& p, const glm::dvec3& ceiling, double intensity) {
  constexpr double kDrop = 0.55;
  const glm::dvec3 at = ceiling - glm::dvec3(0.0, kDrop, 0.0);
  Node lamp{.name = "lamp"};
  add_box(lamp.in(p.lamp), {at + glm::dvec3(-0.6, -0.04, -0.15), at + glm::dvec3(0.6, 0.0, 0.15)});
  for (const double x : {-0.5, 0.5}) {
    add_bar(lamp.in(p.stripe), at + glm::dvec3(x, 0.0, 0.0), ceiling + glm::dvec3(x, 0.0, 0.0), 0.006, 0.006, 12);
  }
  scene.nodes.push_back(std::move(lamp));
  scene.nodes.push_back(Node{.name = "lamp_light",
                             .translation = at - glm::dvec3(0.0, 0.08, 0.0),
                             .light = Light{Light::Type::point, {1.0, 0.96, 0.90}, intensity}});
}

// Where a car stands, and where the middle of its front plate lies from there.
struct CarPlace {
  glm::dvec3 place;
  double yaw;
  double plate_height, plate_ahead;  // m
};

// Lettering on a car's blank plate.
void add_number_plate(SceneModel& scene, const Font& font, std::string name, std::string_view text, const CarPlace& car,
                      const ChartMaterials& materials) {
  const glm::dquat turn = glm::angleAxis(car.yaw, glm::dvec3(0.0, 1.0, 0.0));
  Node plate{.name = std::move(name),
             .translation = car.place + turn * glm::dvec3(0.0, car.plate_height, car.plate_ahead),
             .rotation = turn};
  constexpr double kEm = 0.085, kHalfWidth = 0.25, kHalfHeight = 0.043;  // m
  add_box(plate.in(materials.paper), {{-kHalfWidth, -kHalfHeight, -0.006}, {kHalfWidth, kHalfHeight, 0.0}});
  add_text(plate.in(materials.ink), font, text, {-0.5 * kEm * font.width(text), -0.028}, kEm, 0.0005, 1e-4);
  plate.target = true;
  scene.nodes.push_back(std::move(plate));
}

glm::dvec3 ahead(const glm::dvec3& eyes, double distance, double right_deg, double up_deg) {
  const double r = glm::radians(right_deg), u = glm::radians(up_deg);
  return eyes + distance * glm::dvec3(std::cos(u) * std::sin(r), std::sin(u), -std::cos(u) * std::cos(r));
}

void add_sheet(SceneModel& scene, Node sheet, const glm::dvec3& at, double right_deg, double up_deg) {
  sheet.translation = at;
  sheet.rotation = glm::angleAxis(-glm::radians(right_deg), glm::dvec3(0.0, 1.0, 0.0)) *
                   glm::angleAxis(glm::radians(up_deg), glm::dvec3(1.0, 0.0, 0.0));
  sheet.target = true;
  scene.nodes.push_back(std::move(sheet));
}

void add_target(SceneModel& scene, std::string name, const glm::dvec3& at) {
  scene.nodes.push_back(Node{.name = std::move(name), .translation = at, .target = true});
}

}  // namespace

void add_model(SceneModel& scene, const Model& model, const std::string& name, double size, const glm::dvec3& place,
               double yaw) {
  const glm::dvec3 extent = model.bounds.high - model.bounds.low, middle = 0.5 * (model.bounds.high + model.bounds.low);
  const double scale = size / std::max(extent.x, extent.z);
  const glm::dvec3 foot(middle.x, model.bounds.low.y, middle.z);
  const glm::dmat4 local = glm::scale(glm::dmat4(1.0), glm::dvec3(scale)) * glm::translate(glm::dmat4(1.0), -foot);
  Node node{
      .name = kModelPrefix + name, .translation = place, .rotation = glm::angleAxis(yaw, glm::dvec3(0.0, 1.0, 0.0))};
  const std::size_t first = scene.materials.size();
  for (Material material : model.materials) {
    material.name = name + " " + material.name;
    scene.add(std::move(material));
  }
  for (const ModelPart& part : model.parts) {
    node.in(first + part.material).append(with_normals(part, glm::radians(kCrease_deg)), local);
  }
  scene.nodes.push_back(std::move(node));
}

std::size_t model_triangle_count(const SceneModel& scene) {
  std::size_t count = 0;
  for (const Node& node : scene.nodes) {
    if (!node.name.starts_with(kModelPrefix)) continue;
    for (const auto& [material, mesh] : node.parts) count += mesh.indices.size() / 3;
  }
  return count;
}

SceneModel make_car_scene(const std::string& models, const std::string& font_path) {
  const Font font(font_path);
  SceneModel scene;
  scene.environment.ambient = {0.50, 0.50, 0.51};
  const HallPalette p = hall_palette(scene);
  const ChartMaterials chart{scene.add(Material{.name = "paper", .base_colour = glm::dvec3(0.85)}),
                             scene.add(Material{.name = "ink", .base_colour = glm::dvec3(0.02)}),
                             scene.add(Material{.name = "board", .base_colour = glm::dvec3(0.25)})};
  scene.nodes.push_back(Node{.name = "start", .translation = kHallEyes, .camera = true});
  add_hall(scene, p, kHall, 1.0);
  for (const glm::dvec3& at : {glm::dvec3(0.0, 3.4, -2.5), glm::dvec3(0.0, 3.4, -7.5)}) {
    add_lamp(scene, p, at, 11.0);
  }
  // The catalogue's lengths: 439.8, 424.9 and 435.8 cm.
  const CarPlace sedan{{-2.2, 0.0, -4.2}, glm::radians(28.0), 0.373, 2.206};
  const CarPlace sport{{2.5, 0.0, -4.6}, glm::radians(-32.0), 0.400, 2.131};
  add_model(scene, read_model(models + "/concept-sedan-02.glb"), "sedan", 4.398, sedan.place, sedan.yaw);
  add_model(scene, read_model(models + "/concept-sedan-02-sport.glb"), "sport", 4.249, sport.place, sport.yaw);
  add_number_plate(scene, font, "number_plate", "VG 2012 A", sedan, chart);
  add_number_plate(scene, font, "second_plate", "NSG 480", sport, chart);
  add_model(scene, read_model(models + "/fordFocus.glb"), "ford", 4.358, {0.3, 0.0, -9.0}, glm::radians(80.0));
  add_sheet(scene, near_card(chart, font), ahead(kHallEyes, 0.40, 0.0, -30.0), 0.0, -30.0);
  const glm::dvec3 on_wall{0.0, 2.35, kHall.low.z + 0.03};
  Node letters = etdrs_chart(chart, glm::length(on_wall - kHallEyes));
  letters.parts.erase(chart.paper);  // a sheet for 4 m; letters for the far wall need a larger one
  letters.parts.erase(chart.board);
  add_quad(letters.in(chart.paper), {-0.95, -0.95, 0.0}, {0.95, -0.95, 0.0}, {0.95, 0.95, 0.0}, {-0.95, 0.95, 0.0});
  add_sheet(scene, std::move(letters), on_wall, 0.0, 0.0);
  add_target(scene, "far_car", {0.3, 0.9, -8.1});
  return scene;
}

SceneModel make_table_scene(const std::string& model, double size) {
  SceneModel scene;
  scene.environment.ambient = {0.50, 0.50, 0.51};
  const HallPalette p = hall_palette(scene);
  const MaterialId wood = scene.add(Material{.name = "table", .base_colour = {0.36, 0.20, 0.10}, .roughness = 0.6});
  scene.nodes.push_back(Node{.name = "start",
                             .translation = kTableEyes,
                             .rotation = glm::angleAxis(glm::radians(-25.0), glm::dvec3(1.0, 0.0, 0.0)),
                             .camera = true});
  add_hall(scene, p, kStudy, 0.5);
  add_lamp(scene, p, {0.6, kStudy.high.y, -0.2}, 5.0);
  Node table{.name = "table"};
  add_rounded_box(table.in(wood), {{-0.7, kTableHeight - 0.03, -1.1}, {0.7, kTableHeight, -0.2}}, 0.008);
  for (const double x : {-0.65, 0.6}) {
    for (const double z : {-1.05, -0.3})
      add_box(table.in(wood), {{x, 0.0, z}, {x + 0.05, kTableHeight - 0.03, z + 0.05}});
  }
  scene.nodes.push_back(std::move(table));
  const glm::dvec3 place{0.0, kTableHeight, -0.62};
  const Model thing = read_model(model);
  add_model(scene, thing, "on_table", size, place, glm::radians(20.0));
  add_target(scene, "on_table", place + glm::dvec3(0.0, 0.04, 0.0));
  add_target(scene, "wall", {0.0, 1.2, kStudy.low.z});
  return scene;
}

}  // namespace assets
