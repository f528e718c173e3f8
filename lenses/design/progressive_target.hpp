// What a progressive design asks for at each place of the surface: a mean power, and what deviations from it and
// cylinder cost there. Three areas are dear: the distance zone, which opens upward like a fan, the near zone, an
// upright oval below the near point, and the line that joins them, where the surface is to be umbilic. Hardness opens
// the fan, widens the near zone, sharpens their borders, raises their price over that of the sides, and evens the rise
// of power down the corridor.
#pragma once

#include "lenses/design/progressive.hpp"

namespace lenses {

struct DesignTarget {
  double power;                          // D
  double power_weight, cylinder_weight;  // of squared D
};

class ProgressiveTarget {
 public:
  explicit ProgressiveTarget(const ProgressiveConfig& config)
      : config_(config), distance_(config.distance_power), addition_(config.addition) {}

  [[nodiscard]] DesignTarget at(const glm::dvec2& p) const;

  // What was missing at the two points is asked for in addition, so that what is reached comes out as ordered.
  void ask_for_more(double distance, double addition) {
    distance_ += distance;
    addition_ += addition;
  }

 private:
  // Distance from the line fitting cross - near point (upright beyond its ends) and down from the fitting cross, m.
  struct Place {
    double aside, below;
  };
  [[nodiscard]] Place place(const glm::dvec2& p) const;
  [[nodiscard]] double between(double soft, double hard) const { return soft + (hard - soft) * config_.hardness; }
  [[nodiscard]] double rise(double below) const;
  [[nodiscard]] double in_zones(const Place& place) const;
  [[nodiscard]] double on_line(const Place& place) const;

  ProgressiveConfig config_;
  double distance_, addition_;  // D
};

}  // namespace lenses
