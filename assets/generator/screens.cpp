#include "assets/generator/screens.hpp"

#include <array>
#include <glm/gtc/constants.hpp>
#include <string_view>

#include "assets/generator/ink.hpp"
#include "assets/generator/optotypes.hpp"

namespace assets {
namespace {

constexpr double kFlatness = 7e-5;  // m

void add_lines(Mesh& mesh, const Font& font, std::span<const std::string_view> lines, glm::dvec2 origin, double em) {
  for (const std::string_view line : lines) {
    add_text(mesh, font, line, origin, em, kNearInkLift, kFlatness);
    origin.y -= 1.4 * em;
  }
}

}  // namespace

Node monitor(const ScreenMaterials& materials, const Font& font, double distance) {
  constexpr double kWidth = 0.36, kHeight = 0.2025, kBezel = 0.009;  // m
  constexpr std::array<std::string_view, 9> kLines{"To see the world through another's glasses,",
                                                   "begin with the light. Each point of the scene",
                                                   "sends a wave that spreads until it meets the",
                                                   "lens; the glass bends it, more in one place,",
                                                   "less in another, and what reaches the eye is",
                                                   "no longer a sphere. Where the eye can meet",
                                                   "it, the picture is sharp. Where it cannot,",
                                                   "a point becomes a small ellipse, and a word",
                                                   "becomes a guess."};
  Node node{.name = "screen"};
  const glm::dvec2 half(0.5 * kWidth, 0.5 * kHeight);
  add_quad(node.in(materials.page), {-half.x, -half.y, 0.0}, {half.x, -half.y, 0.0}, {half.x, half.y, 0.0},
           {-half.x, half.y, 0.0});
  add_box(node.in(materials.case_colour),
          {{-half.x - kBezel, -half.y - kBezel, -0.03}, {half.x + kBezel, half.y + kBezel, -0.0005}});
  add_ink_rectangle(node.in(materials.bar), {-half.x, half.y - 0.016}, {half.x, half.y}, 0.5 * kNearInkLift);
  Mesh& text = node.in(materials.text);
  add_lines(text, font, std::array<std::string_view, 1>{"Notes on looking"}, {-half.x + 0.008, half.y - 0.0115}, 0.010);
  add_lines(text, font, kLines, {-half.x + 0.014, half.y - 0.036}, 0.0105);
  double x = half.x - 0.062;
  double y = half.y - 0.045;
  for (int i = 0; i < 6; ++i) {
    const double outer = letter_height(0.6 - 0.1 * i, distance);
    for (int j = 0; j < 2; ++j) {
      const double gap = glm::half_pi<double>() * ((i + 3 * j) % 4);
      add_ink(text, landolt_ring(gap), {x + 0.025 * j, y}, outer / 5.0, kNearInkLift);
    }
    y -= 1.7 * outer + 0.012;
  }
  return node;
}

Node phone(const ScreenMaterials& materials, const Font& font) {
  constexpr double kWidth = 0.066, kHeight = 0.140, kBezel = 0.003;  // m
  constexpr std::array<std::string_view, 10> kLines{
      "Are you on the train?", "Yes, with a window seat.", "What can you see?",     "Fields, two herons, rain.",
      "Did you find the map?", "In the blue bag. Thanks!", "I packed your glasses", "as well, the new pair.",
      "Good. I can read this", "without holding it away."};
  Node node{.name = "phone"};
  const glm::dvec2 half(0.5 * kWidth, 0.5 * kHeight);
  add_quad(node.in(materials.page), {-half.x, -half.y, 0.0}, {half.x, -half.y, 0.0}, {half.x, half.y, 0.0},
           {-half.x, half.y, 0.0});
  add_rounded_box(node.in(materials.case_colour),
                  {{-half.x - kBezel, -half.y - kBezel, -0.008}, {half.x + kBezel, half.y + kBezel, -0.0003}}, 0.003);
  add_ink_rectangle(node.in(materials.bar), {-half.x, half.y - 0.013}, {half.x, half.y}, 0.5 * kNearInkLift);
  Mesh& text = node.in(materials.text);
  add_lines(text, font, std::array<std::string_view, 1>{"Anna    10:24"}, {-half.x + 0.005, half.y - 0.0095}, 0.0075);
  for (std::size_t i = 0; i < kLines.size(); ++i) {
    const double y = half.y - 0.024 - 0.0115 * static_cast<double>(i);
    add_lines(text, font, std::span(&kLines[i], 1), {-half.x + 0.005, y}, 0.0053);
  }
  return node;
}

}  // namespace assets
