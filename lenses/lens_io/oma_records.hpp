// The numbers that a job holds of spectacles, as records have them: mm, degrees, right and left.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "lenses/lens.hpp"

namespace lenses::io {

struct OmaNumber {
  using Pair = std::array<std::optional<double>, 2>;  // right, left
  std::string label;
  Pair value;
  bool for_both = false;  // one number, not right;left
};

// pd: monocular, m; they give the bridge's width where nobody else does.
[[nodiscard]] std::vector<OmaNumber> numbers_of(const Spectacles& spectacles, const std::array<double, 2>& pd,
                                                const std::optional<double>& bridge);

// The radius of a sphere (0: flat) as FRNT and BACK hold it, mm; nullopt for a surface that needs a table.
[[nodiscard]] std::optional<double> radius_record(const Surface& surface, const Placement& placement);

// The upright box around an outline (ISO 8624).
struct Box {
  glm::dvec2 low{1e9}, high{-1e9};
  [[nodiscard]] glm::dvec2 centre() const { return 0.5 * (low + high); }
  [[nodiscard]] glm::dvec2 size() const { return high - low; }
};
[[nodiscard]] Box box_of(const std::vector<glm::dvec2>& outline);

}  // namespace lenses::io
