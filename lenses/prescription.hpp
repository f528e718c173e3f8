// What an optician orders, in the terms of ISO 13666; angles in TABO (ISO 8429, as the examiner sees them), radians.
#pragma once

#include <optional>
#include <vector>

namespace lenses {

struct Prism {
  double magnitude = 0.0;  // prism dioptres, cm/m
  double base = 0.0;       // direction of the base, 0..2 pi
  bool operator==(const Prism&) const = default;
};

struct Prescription {
  double sphere = 0.0, cylinder = 0.0, axis = 0.0;  // D, D (either sign), radians
  double addition = 0.0;                            // D
  std::vector<Prism> prism;                         // their sum counts
  bool operator==(const Prescription&) const = default;
};

// What a finished lens is judged against.
struct Order {
  Prescription ordered;
  std::optional<Prescription>
      compensated;  // verification power: what a lensmeter should read, where it is not `ordered`
  bool operator==(const Order&) const = default;
};

}  // namespace lenses
