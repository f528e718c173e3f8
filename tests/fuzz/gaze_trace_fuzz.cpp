// Any bytes make a trace or are refused by InputError; every row of a trace can be used.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <string_view>

#include "tracking/gaze_trace.hpp"
#include "tracking/input_error.hpp"

namespace {

void check(const tracking::TraceRow& row) {
  const bool unit = std::abs(glm::length(row.head.orientation) - 1.0) < 1e-5;
  if (!std::isfinite(row.time) || !row.head.is_finite() || !unit) std::abort();
  for (const glm::dvec3& gaze : row.gaze) {
    if (row.gaze_valid && !(std::abs(glm::length(gaze) - 1.0) < 1e-5)) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const auto trace =
        tracking::parse_gaze_trace(std::string_view(reinterpret_cast<const char*>(data), size), "fuzz.csv");
    if (trace.rows.empty()) std::abort();
    for (const tracking::TraceRow& row : trace.rows) check(row);
  } catch (const tracking::InputError&) {
  }
  return 0;
}
