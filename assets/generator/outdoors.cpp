#include "assets/generator/outdoors.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtx/quaternion.hpp>

#include "assets/generator/ink.hpp"
#include "assets/generator/random.hpp"
#include "assets/generator/reading_room.hpp"

namespace assets {
namespace {

constexpr double kTwoPi = glm::two_pi<double>();

// Point at a distance along the ground from the wearer, angle to the right of straight ahead.
glm::dvec3 on_ground(double distance, double right, double height = 0.0) {
  return {distance * std::sin(right), kGround + height, -distance * std::cos(right)};
}

void add_sun(SceneModel& scene) {
  // From the left, a little behind: into the left window, and onto the sides of tree and house that are seen.
  const glm::dvec3 travel = glm::normalize(glm::dvec3(0.62, -0.60, -0.50));
  const glm::dvec3 from(0.0, 0.0, -1.0);
  scene.nodes.push_back(Node{.name = "sun",
                             .translation = {-10.0, 10.0, 5.0},
                             .rotation = glm::rotation(from, travel),
                             .light = Light{Light::Type::directional, {1.0, 0.95, 0.86}, 3.6}});
}

// Rings that widen with distance, in a patchwork of fields. The plane ends before the hills begin.
void add_ground(SceneModel& scene, const Palette& p) {
  Node node{.name = "ground"};
  constexpr std::array<double, 15> kRadii{0.5,   5.0,   12.0,   25.0,   48.0,   80.0,   130.0,  220.0,
                                          380.0, 650.0, 1100.0, 2000.0, 3800.0, 7000.0, 12500.0};
  constexpr int kSectors = 60;
  Random random(7);
  for (std::size_t ring = 0; ring + 1 < kRadii.size(); ++ring) {
    for (int sector = 0; sector < kSectors; ++sector) {
      const double a = kTwoPi * sector / kSectors, b = kTwoPi * ((sector + 1) % kSectors) / kSectors;
      const MaterialId field = kRadii[ring] < 40.0 ? p.fields[0] : p.fields[random.below(p.fields.size())];
      add_quad(node.in(field), on_ground(kRadii[ring], a), on_ground(kRadii[ring], b), on_ground(kRadii[ring + 1], b),
               on_ground(kRadii[ring + 1], a));
    }
  }
  // A gravel path from the sign to the house.
  const glm::dvec3 from = on_ground(7.0, -0.52, 0.01), to = on_ground(46.5, -0.335, 0.01), across(0.7, 0.0, 0.25);
  add_quad(node.in(p.path), from - across, from + across, to + across, to - across);
  scene.nodes.push_back(std::move(node));
}

// Three ridges behind one another, paler with distance. They rise from below the plane, and their feet are hidden.
void add_hills(SceneModel& scene, const Palette& p) {
  Node node{.name = "hills"};
  constexpr int kSteps = 180;
  struct Ridge {
    double distance, depth, height, roughness;
  };
  constexpr std::array<Ridge, 3> kRidges{
      {{11000.0, 1500.0, 190.0, 0.8}, {14500.0, 2000.0, 420.0, 1.0}, {19000.0, 2500.0, 780.0, 1.2}}};
  for (std::size_t layer = 0; layer < kRidges.size(); ++layer) {
    const Ridge& r = kRidges[layer];
    const auto height = [&](double a) {
      const double phase = 1.7 * static_cast<double>(layer);
      return r.height * (0.72 + 0.16 * std::sin(5.0 * a + phase) + 0.09 * std::sin(13.0 * a + 2.0 * phase) +
                         0.03 * r.roughness * std::sin(37.0 * a + phase) + 0.012 * r.roughness * std::sin(91.0 * a));
    };
    Mesh& mesh = node.in(p.hills[layer]);
    for (int i = 0; i < kSteps; ++i) {
      // Around the left and the front, where the windows are.
      const double a = -2.4 + 3.2 * i / kSteps, b = -2.4 + 3.2 * (i + 1) / kSteps;
      add_quad(mesh, on_ground(r.distance, a, -5.0), on_ground(r.distance, b, -5.0),
               on_ground(r.distance + r.depth, b, height(b)), on_ground(r.distance + r.depth, a, height(a)));
    }
  }
  scene.nodes.push_back(std::move(node));
}

// Trunk, boughs and a crown of leaves, each leaf a rhombus.
void add_leafy_tree(SceneModel& scene, const Palette& p) {
  Node node{.name = "tree_10m", .translation = on_ground(10.6, glm::radians(-35.4))};
  Mesh& bark = node.in(p.bark);
  add_bar(bark, {0.0, -0.1, 0.0}, {0.05, 1.2, 0.0}, 0.20, 0.13, 28);
  add_bar(bark, {0.05, 1.2, 0.0}, {0.02, 3.4, 0.05}, 0.13, 0.06, 24);
  Random random(10);
  const auto direction = [&] {
    const double z = random.uniform(-1.0, 1.0), a = random.uniform(0.0, kTwoPi), s = std::sqrt(1.0 - z * z);
    return glm::dvec3(s * std::cos(a), z, s * std::sin(a));
  };
  for (int bough = 0; bough < 26; ++bough) {
    const double turn = 2.399963 * bough, up = 1.9 + 1.7 * bough / 26.0;  // the golden angle
    const glm::dvec3 from(0.04, std::min(up - 0.3, 3.3), 0.0);
    const double reach = random.uniform(0.55, 1.15) * (1.25 - 0.03 * bough);
    const glm::dvec3 tip(reach * std::cos(turn), up + random.uniform(0.2, 0.7), reach * std::sin(turn));
    add_bar(bark, from, tip, 0.045, 0.012, 10);
    for (int leaf = 0; leaf < 280; ++leaf) {
      const double reached = 0.62 * std::cbrt(random.uniform(0.0, 1.0));
      const glm::dvec3 offset = reached * direction() * glm::dvec3(1.0, 0.75, 1.0);
      const glm::dvec3 along = 0.13 * direction();
      const glm::dvec3 across = 0.075 * glm::normalize(glm::cross(along, glm::dvec3(0.31, 0.2, 0.93)));
      add_leaf(node.in(random.below(3) == 0 ? p.foliage_light : p.foliage), tip + offset, along, across);
    }
  }
  scene.nodes.push_back(std::move(node));
}

// Far trees and bushes: a trunk and a few round masses.
void add_far_trees(SceneModel& scene, const Palette& p) {
  Node node{.name = "far_trees"};
  Random random(3);
  for (int tree = 0; tree < 42; ++tree) {
    const double distance = 62.0 * std::exp(random.uniform(0.0, 2.6)), size = random.uniform(1.6, 3.2);
    const glm::dvec3 foot = on_ground(distance, random.uniform(-1.45, -0.1));
    add_bar(node.in(p.bark), foot, foot + glm::dvec3(0.0, 1.2 * size, 0.0), 0.22, 0.15, 8);
    for (int mass = 0; mass < 4; ++mass) {
      const glm::dvec3 offset{random.uniform(-0.6, 0.6), random.uniform(1.1, 2.0), random.uniform(-0.6, 0.6)};
      add_sphere(node.in(mass % 2 == 0 ? p.foliage : p.foliage_light), foot + size * offset,
                 size * random.uniform(0.55, 0.85), 10);
    }
  }
  scene.nodes.push_back(std::move(node));
}

void add_sign(SceneModel& scene, const Palette& p, const Font& font) {
  Node node{.name = "sign_10m", .translation = kSign.position(), .rotation = kSign.facing(), .target = true};
  add_box(node.in(p.sign_board), {{-0.44, -0.30, -0.03}, {0.44, 0.30, 0.0}});
  Mesh& ink = node.in(p.sign_ink);
  constexpr double kFlat = 5e-4;  // m, 0.2 arcmin
  const auto centred = [&](std::string_view text, double y, double em) {
    add_text(ink, font, text, {-0.5 * em * font.width(text), y}, em, kFarInkLift, kFlat);
  };
  centred("RIVER WALK", 0.13, 0.125);
  centred("Mill and ferry 2 km", -0.02, 0.085);
  centred("Footbridge 800 m", -0.12, 0.06);
  centred("Please keep to the path", -0.19, 0.04);
  centred("no swimming below the weir", -0.245, 0.03);
  for (const double x : {-0.36, 0.36}) {
    add_bar(node.in(p.bark), {x, -1.75, -0.06}, {x, 0.36, -0.06}, 0.035, 0.035, 16);
  }
  scene.nodes.push_back(std::move(node));
}

// A gabled house whose front wall's middle lies in the node's origin on the ground, front toward +z.
void add_house_body(Node& node, const Palette& p, const glm::dvec3& size, double roof) {
  const double x = 0.5 * size.x, eave = 0.35;
  Mesh& wall = node.in(p.house_wall);
  add_box(wall, {{-x, 0.0, -size.z}, {x, size.y, 0.0}});
  const glm::dvec3 ridge_left(-x, size.y + roof, -0.5 * size.z), ridge_right(x, size.y + roof, -0.5 * size.z);
  for (const double side : {-1.0, 1.0}) {
    const glm::dvec3 a(side * x, size.y, side > 0 ? 0.0 : -size.z), b(side * x, size.y, side > 0 ? -size.z : 0.0);
    const glm::dvec3 top = side > 0 ? ridge_right : ridge_left, normal(side, 0.0, 0.0);
    const std::uint32_t first = wall.add_vertex(a, normal);
    wall.add_vertex(b, normal);
    wall.add_vertex(top, normal);
    wall.add_triangle(first, first + 1, first + 2);
  }
  const double drop = roof * eave / (0.5 * size.z);
  Mesh& tiles = node.in(p.house_roof);
  const double y = size.y - drop;
  const glm::dvec3 out(eave, 0.0, 0.0), up(0.0, 0.08, 0.0);
  add_quad(tiles, glm::dvec3(-x - eave, y, eave) + up, glm::dvec3(x + eave, y, eave) + up, ridge_right + out + up,
           ridge_left - out + up);
  add_quad(tiles, glm::dvec3(x + eave, y, -size.z - eave) + up, glm::dvec3(-x - eave, y, -size.z - eave) + up,
           ridge_left - out + up, ridge_right + out + up);
  add_box(node.in(p.house_roof), {{0.25 * size.x, size.y + 0.3 * roof, -0.62 * size.z},
                                  {0.25 * size.x + 0.6, size.y + roof + 0.8, -0.62 * size.z + 0.6}});
}

void add_house_window(Node& node, const Palette& p, double x, double y) {
  constexpr double kHalf = 0.45, kHeight = 1.3, kBar = 0.06;
  add_box(node.in(p.house_window), {{x - kHalf, y, 0.0}, {x + kHalf, y + kHeight, 0.02}});
  Mesh& trim = node.in(p.trim);
  for (const double bar : {x - kHalf - kBar, x - 0.5 * kBar, x + kHalf})
    add_box(trim, {{bar, y, 0.0}, {bar + kBar, y + kHeight, 0.05}});
  for (const double bar : {y - kBar, y + 0.5 * kHeight, y + kHeight})
    add_box(trim, {{x - kHalf - kBar, bar, 0.0}, {x + kHalf + kBar, bar + kBar, 0.06}});
}

void add_house(SceneModel& scene, const Palette& p) {
  glm::dvec3 foot = kHouse.position();
  foot.y = kGround;
  Node node{.name = "house",
            .translation = foot,
            .rotation = glm::angleAxis(glm::radians(-kHouse.right_deg), glm::dvec3(0.0, 1.0, 0.0))};
  add_house_body(node, p, {7.4, 4.6, 6.0}, 2.4);
  for (const double x : {-2.5, 0.0, 2.5}) add_house_window(node, p, x, 2.85);
  for (const double x : {-2.5, 2.5}) add_house_window(node, p, x, 0.75);
  add_box(node.in(p.house_door), {{-0.5, 0.0, 0.0}, {0.5, 2.1, 0.05}});
  add_box(node.in(p.trim), {{-0.6, 2.1, 0.0}, {0.6, 2.22, 0.12}});
  scene.nodes.push_back(std::move(node));
}

// Post-and-rail fence across the garden.
void add_fence(SceneModel& scene, const Palette& p) {
  Node node{.name = "fence"};
  constexpr double kStep = 1.8;
  for (int i = -14; i < 6; ++i) {
    if (i == -4) continue;  // the path's gate
    const glm::dvec3 post(kStep * i, kGround, -18.0 - 0.25 * i), next(kStep * (i + 1), kGround, -18.0 - 0.25 * (i + 1));
    add_bar(node.in(p.bark), post, post + glm::dvec3(0.0, 1.05, 0.0), 0.05, 0.05, 10);
    for (const double y : {0.45, 0.85}) {
      add_bar(node.in(p.bark), post + glm::dvec3(0.0, y, 0.0), next + glm::dvec3(0.0, y, 0.0), 0.03, 0.03, 8);
    }
  }
  scene.nodes.push_back(std::move(node));
}

}  // namespace

void add_outdoors(SceneModel& scene, const Palette& p, const Font& font) {
  add_sun(scene);
  add_ground(scene, p);
  add_hills(scene, p);
  add_leafy_tree(scene, p);
  add_far_trees(scene, p);
  add_sign(scene, p, font);
  add_house(scene, p);
  add_fence(scene, p);
}

}  // namespace assets
