// What a lens made from a prescription is, for people and for programs.
#pragma once

#include <optional>
#include <string>

#include "lenses/design/prescription_lens.hpp"

namespace app {

struct PrescriptionReport {
  std::string output;
  lenses::DesignedLens designed;
  std::optional<double> density;  // kg/m^3, where the material is known
};

[[nodiscard]] std::string to_table(const PrescriptionReport& report);
[[nodiscard]] std::string to_json(const PrescriptionReport& report);

}  // namespace app
