#include <map>
#include <string>
#include <vector>

#include "assets/generator/charts.hpp"
#include "assets/generator/ink.hpp"

namespace assets {
namespace {

constexpr glm::dvec2 kCardSize{0.120, 0.084};           // m
constexpr double kMargin = 0.006, kLabelWidth = 0.007;  // m
constexpr double kFlatness = 1.2e-5;                    // m, 0.1 arcmin at 40 cm

const std::map<int, std::string_view>& paragraphs() {
  static const std::map<int, std::string_view> texts{
      {24, "A letter by the lamp"},
      {18, "came on the last day of May"},
      {14, "and nobody knew the hand it was in."},
      {12, "She held it to the light, then farther away,"},
      {10, "until the words came clear: we have found your"},
      {8, "father's boat, drawn up on the sand below the mill, with her oars laid neatly inside and a jar of plums."},
      {6,
       "The name was painted over but we could read it in the evening sun. If you would like to see her, take the "
       "early train as far as the bridge and ask for the man with the grey dog."},
      {5,
       "He has looked after her all winter, and he will not take a penny for it, although he is glad of company, of "
       "old newspapers, and of anything sweet. Bring warm clothes, and bring your spectacles too: the path is steep."}};
  return texts;
}

// Greedy lines no wider than the given width in em.
std::vector<std::string> break_lines(const Font& font, std::string_view text, double width) {
  std::vector<std::string> lines(1);
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::string word(text.substr(begin, end - begin));
    const std::string longer = lines.back().empty() ? word : lines.back() + " " + word;
    if (!lines.back().empty() && font.width(longer) > width) {
      lines.push_back(word);
    } else {
      lines.back() = longer;
    }
    begin = end + 1;
  }
  return lines;
}

std::string card_label(int points) {
  std::string label(1, 'N');
  label += std::to_string(points);
  return label;
}

}  // namespace

Node near_card(const ChartMaterials& materials, const Font& font) {
  Node node{.name = "near_card"};
  const glm::dvec2 half = 0.5 * kCardSize;
  add_quad(node.in(materials.paper), {-half.x, -half.y, 0.0}, {half.x, -half.y, 0.0}, {half.x, half.y, 0.0},
           {-half.x, half.y, 0.0});
  add_box(node.in(materials.board),
          {{-half.x - 0.001, -half.y - 0.001, -0.0025}, {half.x + 0.001, half.y + 0.001, -0.0002}});
  Mesh& ink = node.in(materials.ink);
  const double left = -half.x + kMargin + kLabelWidth;
  double y = half.y - kMargin;
  for (const int points : kCardPoints) {
    const double em = point_size(points);
    bool first = true;
    for (const std::string& line : break_lines(font, paragraphs().at(points), (half.x - kMargin - left) / em)) {
      y -= (first ? 1.0 : 1.2) * em;
      if (first) add_text(ink, font, card_label(points), {-half.x + 0.003, y}, point_size(7), kNearInkLift, kFlatness);
      add_text(ink, font, line, {left, y}, em, kNearInkLift, kFlatness);
      first = false;
    }
    y -= 0.32 * em + 0.0019;
  }
  return node;
}

}  // namespace assets
