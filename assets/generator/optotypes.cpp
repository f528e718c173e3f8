#include "assets/generator/optotypes.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <stdexcept>

namespace assets {
namespace {

constexpr double kPi = glm::pi<double>();
constexpr int kArcSteps = 12;  // a quarter circle; the chord leaves a 2.5-stroke arc by 0.005 strokes

// Appends the arc about centre from one angle to another (radians), both ends included.
void add_arc(Contour& contour, const glm::dvec2& centre, double radius, double from, double to) {
  const int steps = std::max(1, static_cast<int>(std::lround(std::abs(to - from) / (kPi / 2.0) * kArcSteps)));
  for (int i = 0; i <= steps; ++i) {
    const double angle = from + (to - from) * i / steps;
    contour.push_back(centre + radius * glm::dvec2(std::cos(angle), std::sin(angle)));
  }
}

Contour rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

std::vector<Contour> ring_o() {
  Contour outer, inner;
  add_arc(outer, {2.5, 2.5}, 2.5, 0.0, 2.0 * kPi);
  add_arc(inner, {2.5, 2.5}, 1.5, 2.0 * kPi, 0.0);
  outer.pop_back();
  inner.pop_back();
  return {outer, inner};
}

std::vector<Contour> letter_d() {
  Contour outer{{0.0, 0.0}}, inner{{1.0, 4.0}};
  add_arc(outer, {2.5, 2.5}, 2.5, -kPi / 2.0, kPi / 2.0);
  outer.emplace_back(0.0, 5.0);
  add_arc(inner, {2.5, 2.5}, 1.5, kPi / 2.0, -kPi / 2.0);
  inner.emplace_back(1.0, 1.0);
  return {outer, inner};
}

std::vector<Contour> letter_r() {
  Contour outer{{1.0, 2.0}}, inner{{1.0, 4.0}};
  add_arc(outer, {3.5, 3.5}, 1.5, -kPi / 2.0, kPi / 2.0);
  outer.emplace_back(1.0, 5.0);
  add_arc(inner, {3.5, 3.5}, 0.5, kPi / 2.0, -kPi / 2.0);
  inner.emplace_back(1.0, 3.0);
  return {rectangle(0.0, 0.0, 1.0, 5.0), outer, inner, {{3.75, 0.0}, {5.0, 0.0}, {3.125, 2.5}, {1.875, 2.5}}};
}

// Two bows and the bar between them, one stroke wide all along.
std::vector<Contour> letter_s() {
  const auto side = [](double offset) {
    Contour line;
    add_arc(line, {3.5, 3.5}, 1.0 + offset, 0.0, kPi / 2.0);
    add_arc(line, {1.5, 3.5}, 1.0 + offset, kPi / 2.0, 1.5 * kPi);
    add_arc(line, {3.5, 1.5}, 1.0 - offset, kPi / 2.0, -kPi / 2.0);
    add_arc(line, {1.5, 1.5}, 1.0 - offset, -kPi / 2.0, -kPi);
    return line;
  };
  Contour contour = side(0.5);
  const Contour back = side(-0.5);
  contour.insert(contour.end(), back.rbegin(), back.rend());
  return {contour};
}

// A straight stroke between two heights: it covers [x_low, x_low + width] at y = 0 and the like at y = 5. A stroke one
// unit thick that runs from corner to corner of the square is 1.25 wide; one of the V's is 1.0743 wide.
Contour slanted(double x_low, double x_high, double width) {
  return {{x_low, 0.0}, {x_low + width, 0.0}, {x_high + width, 5.0}, {x_high, 5.0}};
}

}  // namespace

std::vector<Contour> landolt_ring(double gap_angle) {
  // The gap's sides are parallel, half a stroke from its axis, and end on both circles.
  const double outer_half = std::asin(0.5 / 2.5), inner_half = std::asin(0.5 / 1.5);
  Contour contour;
  add_arc(contour, {0.0, 0.0}, 2.5, gap_angle + outer_half, gap_angle + 2.0 * kPi - outer_half);
  add_arc(contour, {0.0, 0.0}, 1.5, gap_angle + 2.0 * kPi - inner_half, gap_angle + inner_half);
  return {contour};
}

std::vector<Contour> sloan_letter(char letter) {
  switch (letter) {
    case 'C': {
      Contour contour;
      const double outer_half = std::asin(0.5 / 2.5), inner_half = std::asin(0.5 / 1.5);
      // In three pieces, so that the polygon has corners at the letter's top, bottom and left.
      add_arc(contour, {2.5, 2.5}, 2.5, outer_half, kPi / 2.0);
      add_arc(contour, {2.5, 2.5}, 2.5, kPi / 2.0, 1.5 * kPi);
      add_arc(contour, {2.5, 2.5}, 2.5, 1.5 * kPi, 2.0 * kPi - outer_half);
      add_arc(contour, {2.5, 2.5}, 1.5, 2.0 * kPi - inner_half, inner_half);
      return {contour};
    }
    case 'D':
      return letter_d();
    case 'H':
      return {rectangle(0.0, 0.0, 1.0, 5.0), rectangle(4.0, 0.0, 5.0, 5.0), rectangle(1.0, 2.0, 4.0, 3.0)};
    case 'K':
      return {rectangle(0.0, 0.0, 1.0, 5.0),
              {{1.0, 1.0}, {5.0, 5.0}, {5.0 - std::sqrt(2.0), 5.0}, {1.0, 1.0 + std::sqrt(2.0)}},
              {{3.75, 0.0}, {5.0, 0.0}, {2.75, 3.0}, {2.1, 2.2}}};
    case 'N':
      return {rectangle(0.0, 0.0, 1.0, 5.0), rectangle(4.0, 0.0, 5.0, 5.0), slanted(3.75, 0.0, 1.25)};
    case 'O':
      return ring_o();
    case 'R':
      return letter_r();
    case 'S':
      return letter_s();
    case 'V': {
      const double width = 1.0743;
      return {slanted(2.5 - 0.5 * width, 0.0, width), slanted(2.5 - 0.5 * width, 5.0 - width, width)};
    }
    case 'Z':
      return {rectangle(0.0, 0.0, 5.0, 1.0), rectangle(0.0, 4.0, 5.0, 5.0), slanted(0.0, 3.75, 1.25)};
    default:
      throw std::invalid_argument(std::string("not a Sloan letter: ") + letter);
  }
}

double letter_height(double logmar, double distance) {
  const double angle = 5.0 * std::pow(10.0, logmar) / 60.0 * kPi / 180.0;
  return distance * std::tan(angle);
}

}  // namespace assets
