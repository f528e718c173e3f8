// The trade-off as a page, which shows tradeoff.svg and each setting's picture beside the reference.
#pragma once

#include <string>

#include "app/tradeoff/tradeoff_row.hpp"
#include "render/image/image.hpp"

namespace app {

inline constexpr double kDifferenceGain = 8.0;

// Names of a row's files beside the page.
[[nodiscard]] std::string picture_file(const TradeoffRow& row);
[[nodiscard]] std::string difference_file(const TradeoffRow& row);
inline constexpr const char* kReferenceFile = "picture_reference.png";

// Absolute differences of the display values, enlarged.
[[nodiscard]] render::Image8 difference_image(const render::Image8& image, const render::Image8& reference);

[[nodiscard]] std::string tradeoff_page(const TradeoffReport& report);

}  // namespace app
