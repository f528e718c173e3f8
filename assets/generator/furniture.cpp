#include "assets/generator/furniture.hpp"

#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "assets/generator/random.hpp"
#include "assets/generator/reading_room.hpp"
#include "assets/generator/room.hpp"

namespace assets {
namespace {

// One book standing with its spine to +z: cover, and the block of pages between its boards.
void add_book(Node& node, const Palette& p, MaterialId cover, const glm::dvec3& low, const glm::dvec3& size) {
  constexpr double kBoard = 0.0025;
  const glm::dvec3 high = low + size;
  add_box(node.in(cover), {low, {low.x + kBoard, high.y, high.z}});
  add_box(node.in(cover), {{high.x - kBoard, low.y, low.z}, high});
  add_rounded_box(node.in(cover), {{low.x, low.y, high.z - 0.008}, {high.x, high.y, high.z + 0.004}}, 0.0035, 2);
  add_box(node.in(p.book_paper), {low + glm::dvec3(kBoard, 0.003, 0.004), high - glm::dvec3(kBoard, 0.003, 0.007)});
}

// A stem from the table to the middle of a sheet's back, on a round foot.
void add_stand(Node& node, MaterialId material, const glm::dvec3& foot, const glm::dvec3& top) {
  constexpr std::array<glm::dvec2, 4> kFoot{{{0.0, 0.0}, {0.05, 0.0}, {0.045, 0.012}, {0.0, 0.014}}};
  add_lathe(node.in(material), foot, kFoot, 40);
  add_bar(node.in(material), foot, top, 0.006, 0.005, 20);
}

// A mug of the usual shape, outside then inside.
void add_mug(Node& node, MaterialId material, const glm::dvec3& base) {
  constexpr std::array<glm::dvec2, 9> kProfile{{{0.0, 0.0},
                                                {0.034, 0.0},
                                                {0.039, 0.006},
                                                {0.040, 0.088},
                                                {0.0395, 0.092},
                                                {0.037, 0.092},
                                                {0.036, 0.088},
                                                {0.035, 0.012},
                                                {0.0, 0.010}}};
  add_lathe(node.in(material), base, kProfile, 48);
  constexpr int kSteps = 14;
  const auto handle = [&](int i) {
    const double angle = glm::pi<double>() * (0.5 - static_cast<double>(i) / kSteps);
    return base + glm::dvec3(0.039 + 0.028 * std::cos(angle), 0.048 + 0.028 * std::sin(angle), 0.0);
  };
  for (int i = 0; i < kSteps; ++i) add_bar(node.in(material), handle(i), handle(i + 1), 0.0055, 0.0055, 12);
}

void add_vase(Node& node, MaterialId material, const glm::dvec3& base) {
  constexpr int kSteps = 20;
  std::vector<glm::dvec2> profile{{0.0, 0.0}};
  for (int i = 0; i <= kSteps; ++i) {
    const double t = static_cast<double>(i) / kSteps;
    profile.emplace_back(0.045 + 0.045 * std::sin(2.6 * t + 0.3) * (1.0 - 0.4 * t) - 0.012 * t, 0.30 * t);
  }
  add_lathe(node.in(material), base, profile, 48, Profile::smooth);
}

}  // namespace

void add_table(SceneModel& scene, const Palette& p) {
  Node node{.name = "table"};
  constexpr double kLeft = -0.62, kRight = 0.72, kNear = -0.16, kFar = -0.88;
  add_box(node.in(p.wood), {{kLeft, kTableTop - 0.03, kFar}, {kRight, kTableTop, kNear}}, 0.8);
  add_box(node.in(p.wood),
          {{kLeft + 0.08, kTableTop - 0.10, kFar + 0.06}, {kRight - 0.08, kTableTop - 0.03, kNear - 0.06}}, 0.8);
  for (const double x : {kLeft + 0.07, kRight - 0.07}) {
    for (const double z : {kFar + 0.07, kNear - 0.07}) {
      add_bar(node.in(p.dark_wood), {x, 0.0, z}, {x, kTableTop - 0.03, z}, 0.018, 0.032, 28);
    }
  }
  scene.nodes.push_back(std::move(node));
}

void add_table_things(SceneModel& scene, const Palette& p) {
  Node node{.name = "table_things"};
  const double y = kTableTop;
  add_stand(node, p.metal, {0.0, y, -0.44}, kNearCard.position() + glm::dvec3(0.0, -0.002, -0.004));
  add_stand(node, p.metal, {kPhone.position().x + 0.03, y, -0.33},
            kPhone.position() + glm::dvec3(0.004, -0.006, -0.008));
  const glm::dvec3 screen = kScreen.position();
  add_bar(node.in(p.screen.case_colour), {0.0, y, screen.z - 0.06}, {0.0, screen.y, screen.z - 0.025}, 0.018, 0.018,
          32);
  add_rounded_box(node.in(p.screen.case_colour), {{-0.11, y, screen.z - 0.14}, {0.11, y + 0.014, screen.z + 0.03}},
                  0.007);
  add_mug(node, p.ceramic, {-0.36, y, -0.46});
  // Three books lying on one another, spines to the left.
  double height = y;
  for (int i = 0; i < 3; ++i) {
    const double thick = 0.022 + 0.007 * i;
    Mesh lying;
    Node book;
    add_book(book, p, p.books[static_cast<std::size_t>(2 * i + 1)], {0.0, -0.11 + 0.006 * i, -0.08},
             {thick, 0.21 - 0.014 * i, 0.15});
    // Laid on its side: its width becomes its height.
    glm::dmat4 place = glm::translate(glm::dmat4(1.0), {0.56, height, -0.56});
    place = glm::rotate(place, 0.16 * (i - 1), {0.0, 1.0, 0.0});
    place = glm::rotate(place, glm::half_pi<double>(), {0.0, 0.0, 1.0});
    for (const auto& [material, mesh] : book.parts) node.in(material).append(mesh, place);
    height += thick;
  }
  for (int i = 0; i < 2; ++i) {  // two pencils
    add_bar(node.in(p.books[static_cast<std::size_t>(3 * i)]), {-0.34 + 0.03 * i, y + 0.004, -0.26},
            {-0.22 + 0.05 * i, y + 0.004, -0.36}, 0.0038, 0.0038, 6);
  }
  scene.nodes.push_back(std::move(node));
}

void add_bookshelf(SceneModel& scene, const Palette& p) {
  Node node{.name = "bookshelf"};
  constexpr double kLeft = 1.75, kRight = 3.0, kTop = 2.10, kBoard = 0.024, kPitch = 0.345;
  const double back = kRoom.low.z, front = back + 0.30;
  Mesh& wood = node.in(p.wood);
  add_box(wood, {{kLeft, 0.0, back}, {kLeft + kBoard, kTop, front}}, 0.8);
  add_box(wood, {{kRight - kBoard, 0.0, back}, {kRight, kTop, front}}, 0.8);
  add_box(wood, {{kLeft, 0.0, back}, {kRight, kTop, back + 0.008}}, 0.8);
  Random random(2012);
  for (int shelf = 0; shelf <= 6; ++shelf) {
    const double y = 0.005 + kPitch * shelf;
    add_box(wood, {{kLeft, y, back}, {kRight, y + kBoard, front}}, 0.8);
    if (shelf == 6) break;
    const double end = kRight - kBoard - random.uniform(0.05, 0.40);
    for (double x = kLeft + kBoard + 0.004; x < end;) {
      const glm::dvec3 size{random.uniform(0.014, 0.052), random.uniform(0.19, 0.30), random.uniform(0.13, 0.21)};
      add_book(node, p, p.books[random.below(p.books.size())], {x, y + kBoard, front - 0.03 - size.z}, size);
      x += size.x + 0.0015;
    }
  }
  scene.nodes.push_back(std::move(node));
}

void add_cabinet(SceneModel& scene, const Palette& p) {
  Node node{.name = "cabinet"};
  const double back = kRoom.low.z, front = back + 0.40;
  add_box(node.in(p.wood), {{-0.45, 0.10, back}, {1.25, 0.72, front}}, 0.8);
  add_box(node.in(p.wood), {{-0.47, 0.72, back}, {1.27, 0.75, front + 0.02}}, 0.8);
  for (int i = 0; i < 3; ++i) {
    const double x = -0.45 + 1.70 * i / 3.0;
    add_rounded_box(node.in(p.wood), {{x + 0.02, 0.13, front - 0.01}, {x + 1.70 / 3.0 - 0.02, 0.69, front + 0.016}},
                    0.008);
    add_sphere(node.in(p.metal), {x + 1.70 / 6.0, 0.60, front + 0.03}, 0.015, 20);
  }
  for (const double x : {-0.38, 1.18}) {
    add_bar(node.in(p.dark_wood), {x, 0.0, front - 0.06}, {x, 0.10, front - 0.06}, 0.015, 0.02, 20);
  }
  add_vase(node, p.ceramic, {1.05, 0.75, back + 0.20});
  add_sphere(node.in(p.books[0]), {0.80, 0.79, back + 0.22}, 0.040, 28);
  add_sphere(node.in(p.books[3]), {0.71, 0.79, back + 0.24}, 0.040, 28);
  // Brackets that hold the two wall charts at their distance.
  for (const Placement& chart : {kEtdrsChart, kClockDial}) {
    const glm::dvec3 middle = chart.position();
    add_bar(node.in(p.dark_wood), {middle.x, middle.y, back}, middle + glm::dvec3(0.0, 0.0, -0.015), 0.02, 0.02, 20);
  }
  scene.nodes.push_back(std::move(node));
}

void add_armchair(SceneModel& scene, const Palette& p) {
  Node node{.name = "armchair",
            .translation = {-2.55, 0.0, -3.30},
            .rotation = glm::angleAxis(0.75, glm::dvec3(0.0, 1.0, 0.0))};
  Mesh& fabric = node.in(p.fabric);
  add_rounded_box(fabric, {{-0.40, 0.14, -0.38}, {0.40, 0.34, 0.36}}, 0.05, 8);
  add_rounded_box(fabric, {{-0.42, 0.14, -0.46}, {0.42, 0.86, -0.28}}, 0.07, 8);
  add_rounded_box(fabric, {{-0.50, 0.14, -0.42}, {-0.34, 0.58, 0.38}}, 0.06, 8);
  add_rounded_box(fabric, {{0.34, 0.14, -0.42}, {0.50, 0.58, 0.38}}, 0.06, 8);
  add_rounded_box(node.in(p.cushion), {{-0.33, 0.33, -0.26}, {0.33, 0.46, 0.38}}, 0.055, 8);
  for (const double x : {-0.40, 0.40}) {
    for (const double z : {-0.36, 0.30}) add_bar(node.in(p.dark_wood), {x, 0.0, z}, {x, 0.16, z}, 0.016, 0.024, 20);
  }
  scene.nodes.push_back(std::move(node));
}

namespace {

// A framed picture in its own frame (x right, y up, z into the room), `size` across the canvas.
void add_painting(SceneModel& scene, const Palette& p, std::string name, MaterialId canvas, const glm::dvec2& size,
                  const glm::dvec3& middle, double yaw) {
  Node node{.name = std::move(name), .translation = middle, .rotation = glm::angleAxis(yaw, glm::dvec3(0.0, 1.0, 0.0))};
  constexpr double kFrame = 0.035;
  const glm::dvec2 h = 0.5 * size, o = h + kFrame;
  add_quad(node.in(canvas), {-h.x, -h.y, 0.012}, {h.x, -h.y, 0.012}, {h.x, h.y, 0.012}, {-h.x, h.y, 0.012});
  Mesh& frame = node.in(p.metal);
  add_rounded_box(frame, {{-o.x, h.y, 0.0}, {o.x, o.y, 0.028}}, 0.01);
  add_rounded_box(frame, {{-o.x, -o.y, 0.0}, {o.x, -h.y, 0.028}}, 0.01);
  add_rounded_box(frame, {{-o.x, -o.y, 0.0}, {-h.x, o.y, 0.028}}, 0.01);
  add_rounded_box(frame, {{h.x, -o.y, 0.0}, {o.x, o.y, 0.028}}, 0.01);
  scene.nodes.push_back(std::move(node));
}

}  // namespace

void add_paintings(SceneModel& scene, const Palette& p) {
  add_painting(scene, p, "painting_bay", p.painting_bay, {0.75, 0.50}, {kRoom.high.x, 1.55, -2.75},
               -glm::half_pi<double>());
  add_painting(scene, p, "painting_evening", p.painting_evening, {0.36, 0.45}, {1.27, 1.62, kRoom.low.z}, 0.0);
}

void add_plant(SceneModel& scene, const Palette& p) {
  Node node{.name = "houseplant", .translation = {-0.78, 0.0, -3.68}};
  constexpr std::array<glm::dvec2, 6> kPot{
      {{0.0, 0.0}, {0.12, 0.0}, {0.16, 0.30}, {0.17, 0.30}, {0.17, 0.33}, {0.15, 0.33}}};
  add_lathe(node.in(p.ceramic), {0.0, 0.0, 0.0}, kPot, 48);
  constexpr std::array<glm::dvec2, 2> kSoil{{{0.155, 0.29}, {0.0, 0.30}}};
  add_lathe(node.in(p.soil), {0.0, 0.0, 0.0}, kSoil, 32);
  Random random(52);
  for (int branch = 0; branch < 16; ++branch) {
    const double turn = 2.399963 * branch;  // the golden angle spreads the branches evenly
    const double lean = random.uniform(0.08, 0.32), rise = random.uniform(0.35, 0.85);
    const glm::dvec3 out(std::cos(turn), 0.0, std::sin(turn)), side(-out.z, 0.0, out.x);
    glm::dvec3 from(0.03 * out.x, 0.29, 0.03 * out.z);
    for (int i = 1; i <= 8; ++i) {
      const double t = i / 8.0;
      const glm::dvec3 to = glm::dvec3(0.0, 0.29 + rise * t * (1.0 - 0.25 * t), 0.0) + lean * t * t * out + 0.03 * out;
      add_bar(node.in(p.stem), from, to, 0.006 - 0.004 * t, 0.0055 - 0.004 * t, 8);
      for (const double hand : {-1.0, 1.0}) {
        if (i < 2) continue;
        const glm::dvec3 along =
            0.13 * glm::normalize(0.7 * out + hand * 0.9 * side + glm::dvec3(0.0, random.uniform(-0.3, 0.6), 0.0));
        add_leaf(node.in(p.leaf), to, along, 0.055 * glm::normalize(glm::cross(along, glm::dvec3(0.1, 1.0, 0.0))));
      }
      from = to;
    }
  }
  scene.nodes.push_back(std::move(node));
}

}  // namespace assets
