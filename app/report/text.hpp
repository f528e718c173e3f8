// Numbers and lines of text in reports.
#pragma once

#include <optional>
#include <string>

namespace app {

// As printf does.
[[nodiscard, gnu::format(printf, 1, 2)]] std::string format(const char* pattern, ...);

// "-" for none; signed_number has its + too, but a zero has no sign.
[[nodiscard]] std::string number(std::optional<double> value, int decimals);
[[nodiscard]] std::string signed_number(std::optional<double> value, int decimals);

}  // namespace app
