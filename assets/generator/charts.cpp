#include "assets/generator/charts.hpp"

#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/gtc/constants.hpp>

#include "assets/generator/ink.hpp"
#include "assets/generator/optotypes.hpp"

namespace assets {
namespace {

// White sheet of the given size on a thin board behind it.
void add_sheet(Node& node, const ChartMaterials& materials, const glm::dvec2& size, double margin, double thickness) {
  const glm::dvec2 half = 0.5 * size, outer = half + margin;
  add_quad(node.in(materials.paper), {-half.x, -half.y, 0.0}, {half.x, -half.y, 0.0}, {half.x, half.y, 0.0},
           {-half.x, half.y, 0.0});
  add_box(node.in(materials.board), {{-outer.x, -outer.y, -thickness}, {outer.x, outer.y, -0.001}});
}

}  // namespace

Node etdrs_chart(const ChartMaterials& materials, double distance) {
  Node node{.name = "etdrs_chart"};
  add_sheet(node, materials, {0.62, 0.60}, 0.012, 0.02);
  double height = 0.0;
  for (std::size_t row = 0; row < kEtdrsRows.size(); ++row) {
    height += letter_height(etdrs_logmar(row), distance) * (row == 0 ? 1.0 : 2.0);
  }
  double top = 0.5 * height;
  for (std::size_t row = 0; row < kEtdrsRows.size(); ++row) {
    const double letter = letter_height(etdrs_logmar(row), distance);
    if (row > 0) top -= letter;
    for (std::size_t i = 0; i < kEtdrsRows[row].size(); ++i) {
      const double left = (2.0 * static_cast<double>(i) - 4.5) * letter;
      add_ink(node.in(materials.ink), sloan_letter(kEtdrsRows[row][i]), {left, top - letter}, letter / 5.0,
              kFarInkLift);
    }
    top -= letter;
  }
  return node;
}

Node clock_dial(const ChartMaterials& materials, const Font& font) {
  constexpr double kInner = 0.055, kOuter = 0.175, kLine = 0.0035, kNumber = 0.205, kRadius = 0.25;  // m
  Node node{.name = "clock_dial"};
  Contour round;
  for (int i = 0; i < 96; ++i) {
    const double angle = glm::two_pi<double>() * i / 96;
    round.emplace_back(kRadius * std::cos(angle), kRadius * std::sin(angle));
  }
  add_ink(node.in(materials.paper), std::array{round}, {0.0, 0.0}, 1.0, 0.0);
  Mesh plate;
  constexpr std::array<glm::dvec2, 4> kPlate{
      {{0.0, -0.02}, {kRadius + 0.012, -0.02}, {kRadius + 0.012, -0.001}, {0.0, -0.001}}};
  add_lathe(plate, {0.0, 0.0, 0.0}, kPlate, 96);
  node.in(materials.board).append(plate, glm::rotate(glm::dmat4(1.0), glm::half_pi<double>(), {1.0, 0.0, 0.0}));
  Mesh& ink = node.in(materials.ink);
  for (int hour = 1; hour <= 12; ++hour) {
    const double angle = glm::radians(90.0 - 30.0 * hour);
    const glm::dvec2 out(std::cos(angle), std::sin(angle)), across(-out.y, out.x);
    for (int line = -1; line <= 1; ++line) {
      const glm::dvec2 middle = 2.0 * line * kLine * across;
      const Contour bar{middle + kInner * out - 0.5 * kLine * across, middle + kOuter * out - 0.5 * kLine * across,
                        middle + kOuter * out + 0.5 * kLine * across, middle + kInner * out + 0.5 * kLine * across};
      add_ink(ink, std::array{bar}, {0.0, 0.0}, 1.0, kFarInkLift);
    }
    const std::string number = std::to_string(hour);
    constexpr double kEm = 0.04, kDigitHeight = 0.66;  // Liberation Serif's digits are 0.66 em high
    const glm::dvec2 origin = kNumber * out - 0.5 * kEm * glm::dvec2(font.width(number), kDigitHeight);
    add_text(ink, font, number, origin, kEm, kFarInkLift, 2e-4);
  }
  return node;
}

}  // namespace assets
