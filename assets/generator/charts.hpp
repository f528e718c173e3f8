// The charts, each as a node in its own frame: the sheet's middle at the origin, x right, y up, z toward the eyes.
// Sizes are exact for the distance at which the chart hangs.
#pragma once

#include <array>
#include <string_view>

#include "assets/generator/font.hpp"
#include "assets/generator/scene_model.hpp"

namespace assets {

struct ChartMaterials {
  MaterialId paper, ink, board;
};

// ETDRS: thirteen rows of five Sloan letters from logMAR 1.0 down to -0.2, one letter's width between letters, the
// smaller row's height between rows. No letter occurs twice in a row.
inline constexpr std::array<std::string_view, 13> kEtdrsRows{"NCKZO", "RHSDK", "DOVHR", "CZRHS", "ONHRC",
                                                             "DKSNV", "ZSOKN", "CKDNR", "SRZKD", "HZOVC",
                                                             "NVDOK", "VHCNO", "SVHCZ"};
[[nodiscard]] constexpr double etdrs_logmar(std::size_t row) {
  return 1.0 - 0.1 * static_cast<double>(row);
}
[[nodiscard]] Node etdrs_chart(const ChartMaterials& materials, double distance);

// Astigmatic dial: three parallel lines every 30 degrees, the hours around them.
[[nodiscard]] Node clock_dial(const ChartMaterials& materials, const Font& font);

// Reading card in the N notation: an N-point line is set with an em of N/72 inch (BS 4274-2).
inline constexpr std::array<int, 8> kCardPoints{24, 18, 14, 12, 10, 8, 6, 5};
[[nodiscard]] constexpr double point_size(int points) {
  return points * 0.0254 / 72.0;
}
[[nodiscard]] Node near_card(const ChartMaterials& materials, const Font& font);

}  // namespace assets
