// What a reader does with a trade-off: sentences, and the table they rest on.
#pragma once

#include <string>
#include <vector>

#include "app/tradeoff/tradeoff_row.hpp"

namespace app {

// One sentence each: what the chosen setting gives and costs, what the next worthwhile step up and down the efficient
// line gives and costs, and what mode dof needs for the same error.
[[nodiscard]] std::vector<std::string> advice(const TradeoffReport& report);

// How many steps of Newton's method the surfaces took; empty where none was iterated.
[[nodiscard]] std::string iteration_sentence(const render::IterationHistogram& iterations);

// For a terminal, the advice under it.
[[nodiscard]] std::string tradeoff_table(const TradeoffReport& report);

}  // namespace app
