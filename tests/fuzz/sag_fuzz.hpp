// What the harnesses of the three formats of tables do: any bytes make a table of heights or are refused by InputError,
// in both row orders; no small file makes a large table; what is read can be fitted.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "lenses/lens_io/sag_file.hpp"
#include "tracking/input_error.hpp"

inline int fuzz_sag(lenses::SagFormat format, const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t kMostFitted = 400;  // more would take the time that other inputs need
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  for (const lenses::RowOrder rows : {lenses::RowOrder::top_first, lenses::RowOrder::bottom_first}) {
    try {
      const lenses::SagFile file = parse_sag(format, text, "fuzz", {.rows = rows});
      if (file.samples.points.size() > size) std::abort();
      const bool fits = rows == lenses::RowOrder::top_first && file.samples.points.size() <= kMostFitted;
      if (fits) (void)fit_sag_file(file, "fuzz", {.most_controls = 12});
    } catch (const tracking::InputError&) {
    }
  }
  return 0;
}
