#include "assets/generator/room.hpp"

#include <cmath>
#include <functional>
#include <glm/ext/matrix_transform.hpp>
#include <glm/gtc/constants.hpp>

namespace assets {
namespace {

// A wall is built in its own frame: x along it (to the right, seen from inside), y up, the room on +z, then placed.
// A rectangle of the wall with its uv over the whole wall.
void add_panel(Mesh& mesh, double length, double x0, double y0, double x1, double y1) {
  const std::size_t first = mesh.uvs.size();
  add_quad(mesh, {x0, y0, 0.0}, {x1, y0, 0.0}, {x1, y1, 0.0}, {x0, y1, 0.0});
  for (std::size_t i = first; i < mesh.uvs.size(); ++i) {
    mesh.uvs[i] = {mesh.positions[i].x / length, 1.0 - mesh.positions[i].y / kRoom.high.y};
  }
}

void add_skirting(Node& wall, const Palette& p, double length) {
  add_box(wall.in(p.trim), {{0.0, 0.0, 0.0}, {length, 0.09, 0.014}});
  add_box(wall.in(p.trim), {{0.0, 2.54, 0.0}, {length, kRoom.high.y, 0.03}});
}

// Plaster around an opening, its reveals, a frame with two mullions and a sill.
void add_wall_with_window(Node& wall, const Palette& p, double length, const Opening& o) {
  Mesh& plaster = wall.in(p.plaster);
  add_panel(plaster, length, 0.0, 0.0, o.across_low, kRoom.high.y);
  add_panel(plaster, length, o.across_high, 0.0, length, kRoom.high.y);
  add_panel(plaster, length, o.across_low, 0.0, o.across_high, o.up_low);
  add_panel(plaster, length, o.across_low, o.up_high, o.across_high, kRoom.high.y);
  const double l = o.across_low, r = o.across_high, b = o.up_low, t = o.up_high, d = -kWallThickness;
  Mesh& trim = wall.in(p.trim);
  add_quad(trim, {l, b, 0.0}, {l, b, d}, {l, t, d}, {l, t, 0.0});
  add_quad(trim, {r, b, d}, {r, b, 0.0}, {r, t, 0.0}, {r, t, d});
  add_quad(trim, {l, t, d}, {r, t, d}, {r, t, 0.0}, {l, t, 0.0});
  constexpr double kFrame = 0.055, kMullion = 0.035, kDepth = 0.05;
  const double front = d + kDepth;
  add_box(trim, {{l, b, d}, {l + kFrame, t, front}});
  add_box(trim, {{r - kFrame, b, d}, {r, t, front}});
  add_box(trim, {{l, b, d}, {r, b + kFrame, front}});
  add_box(trim, {{l, t - kFrame, d}, {r, t, front}});
  for (int i = 1; i <= 2; ++i) {
    const double x = l + (r - l) * i / 3.0;
    add_box(trim, {{x - 0.5 * kMullion, b, d}, {x + 0.5 * kMullion, t, front}});
  }
  add_rounded_box(trim, {{l - 0.06, b - 0.035, d}, {r + 0.06, b, 0.14}}, 0.012);
}

// Linen that hangs in folds from a rod.
void add_curtain(Node& wall, const Palette& p, double x0, double x1) {
  constexpr int kFolds = 7, kSteps = 12 * kFolds;
  constexpr double kTop = 2.38, kDepth = 0.035, kAway = 0.10;
  Mesh& mesh = wall.in(p.curtain);
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (int i = 0; i <= kSteps; ++i) {
    const double s = static_cast<double>(i) / kSteps, angle = glm::two_pi<double>() * kFolds * s;
    const double slope = kDepth * std::cos(angle) * glm::two_pi<double>() * kFolds / (x1 - x0);
    const glm::dvec3 normal = glm::normalize(glm::dvec3(-slope, 0.0, 1.0));
    const glm::dvec3 bottom(glm::mix(x0, x1, s), 0.04, kAway + kDepth * std::sin(angle));
    mesh.add_vertex(bottom, normal);
    mesh.add_vertex({bottom.x, kTop, kAway + 0.6 * kDepth * std::sin(angle)}, normal);
  }
  for (std::uint32_t i = 0; i < kSteps; ++i) {
    mesh.add_triangle(first + 2 * i, first + 2 * i + 2, first + 2 * i + 3);
    mesh.add_triangle(first + 2 * i, first + 2 * i + 3, first + 2 * i + 1);
  }
}

void add_curtains(Node& wall, const Palette& p, const Opening& o, double width) {
  add_curtain(wall, p, o.across_low - width, o.across_low - 0.03);
  add_curtain(wall, p, o.across_high + 0.03, o.across_high + width);
  const double y = 2.40, l = o.across_low - width - 0.05, r = o.across_high + width + 0.05;
  add_bar(wall.in(p.metal), {l, y, 0.10}, {r, y, 0.10}, 0.012, 0.012, 20);
  add_sphere(wall.in(p.metal), {l, y, 0.10}, 0.025, 20);
  add_sphere(wall.in(p.metal), {r, y, 0.10}, 0.025, 20);
}

// A door on the wall's face: frame, leaf with four panels, handle.
void add_door(Node& wall, const Palette& p, double x) {
  constexpr double kWidth = 0.86, kHeight = 2.04;
  Mesh& trim = wall.in(p.trim);
  add_box(trim, {{x - 0.08, 0.0, 0.0}, {x, kHeight + 0.08, 0.03}});
  add_box(trim, {{x + kWidth, 0.0, 0.0}, {x + kWidth + 0.08, kHeight + 0.08, 0.03}});
  add_box(trim, {{x, kHeight, 0.0}, {x + kWidth, kHeight + 0.08, 0.03}});
  add_box(wall.in(p.door), {{x, 0.005, 0.0}, {x + kWidth, kHeight, 0.015}});
  for (const double left : {x + 0.10, x + 0.47}) {
    add_rounded_box(wall.in(p.door), {{left, 0.20, 0.0}, {left + 0.29, 0.88, 0.028}}, 0.012);
    add_rounded_box(wall.in(p.door), {{left, 1.06, 0.0}, {left + 0.29, 1.90, 0.028}}, 0.012);
  }
  add_bar(wall.in(p.metal), {x + 0.06, 1.0, 0.015}, {x + 0.06, 1.0, 0.06}, 0.011, 0.011, 20);
  add_bar(wall.in(p.metal), {x + 0.05, 1.0, 0.06}, {x + 0.17, 1.0, 0.06}, 0.009, 0.009, 20);
  add_sphere(wall.in(p.metal), {x + 0.17, 1.0, 0.06}, 0.012, 20);
}

// The wall whose left end (seen from inside) stands at corner, turned by yaw about y.
Node placed(Node wall, const glm::dvec3& corner, double yaw) {
  wall.translation = corner;
  wall.rotation = glm::angleAxis(yaw, glm::dvec3(0.0, 1.0, 0.0));
  return wall;
}

}  // namespace

void add_room(SceneModel& scene, const Palette& p) {
  const glm::dvec3 size = kRoom.high - kRoom.low;
  Node front{.name = "wall_front"};
  const Opening view{kViewWindow.across_low - kRoom.low.x, kViewWindow.across_high - kRoom.low.x, kViewWindow.up_low,
                     kViewWindow.up_high};
  add_wall_with_window(front, p, size.x, view);
  add_curtains(front, p, view, 0.25);
  add_skirting(front, p, size.x);
  scene.nodes.push_back(placed(std::move(front), {kRoom.low.x, 0.0, kRoom.low.z}, 0.0));

  Node left{.name = "wall_left"};
  const Opening sun{kRoom.high.z - kSunWindow.across_high, kRoom.high.z - kSunWindow.across_low, kSunWindow.up_low,
                    kSunWindow.up_high};
  add_wall_with_window(left, p, size.z, sun);
  add_curtains(left, p, sun, 0.30);
  add_skirting(left, p, size.z);
  scene.nodes.push_back(placed(std::move(left), {kRoom.low.x, 0.0, kRoom.high.z}, glm::half_pi<double>()));

  Node right{.name = "wall_right"};
  add_panel(right.in(p.plaster), size.z, 0.0, 0.0, size.z, kRoom.high.y);
  add_skirting(right, p, size.z);
  add_door(right, p, 2.2);
  scene.nodes.push_back(placed(std::move(right), {kRoom.high.x, 0.0, kRoom.low.z}, -glm::half_pi<double>()));

  Node back{.name = "wall_back"};
  add_panel(back.in(p.plaster), size.x, 0.0, 0.0, size.x, kRoom.high.y);
  add_skirting(back, p, size.x);
  scene.nodes.push_back(placed(std::move(back), {kRoom.high.x, 0.0, kRoom.high.z}, glm::pi<double>()));

  Node floor{.name = "floor_and_ceiling"};
  const glm::dvec3 a = kRoom.low, b = kRoom.high;
  add_quad(floor.in(p.floor), {a.x, 0.0, b.z}, {b.x, 0.0, b.z}, {b.x, 0.0, a.z}, {a.x, 0.0, a.z});
  add_quad(floor.in(p.ceiling), {a.x, b.y, a.z}, {b.x, b.y, a.z}, {b.x, b.y, b.z}, {a.x, b.y, b.z});
  Mesh& rug = floor.in(p.rug);
  add_quad(rug, {-1.15, 0.008, 0.15}, {1.35, 0.008, 0.15}, {1.35, 0.008, -1.55}, {-1.15, 0.008, -1.55});
  scene.nodes.push_back(std::move(floor));
}

}  // namespace assets
