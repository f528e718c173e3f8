// Error against time: of the picture, and of the wavefront where a setting changes how it is found.
#pragma once

#include "app/report/log_plot.hpp"
#include "app/tradeoff/tradeoff_row.hpp"

namespace app {

[[nodiscard]] Drawing tradeoff_chart(const TradeoffReport& report);

}  // namespace app
