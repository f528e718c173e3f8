// Accommodation in time: one neural drive for both eyes (Hering), each eye following as far as its own amplitude.
#pragma once

#include <array>
#include <optional>

#include "tracking/delayed_response.hpp"
#include "tracking/live_config.hpp"

namespace tracking {

// The lesser of both eyes' demands, D. An eye whose demand is not finite has none; nothing where neither has.
[[nodiscard]] std::optional<double> shared_demand(const std::array<double, 2>& demand);

// Where the response to a lasting demand comes to rest, D: a lead below the tonic level, a lag above it; never
// negative, as relaxed is the eye's lower end.
[[nodiscard]] double settled_response(const AccommodationConfig& config, double demand);

class Accommodation {
 public:
  // amplitude: D, indexed by Side. The eyes start at rest at the first demand.
  Accommodation(const AccommodationConfig& config, const std::array<double, 2>& amplitude);

  // Each eye's accommodation (D) at `time`, when both eyes' demands (D) become these. Without any demand, and for times
  // that do not increase, the last command stays.
  std::array<double, 2> step(double time, const std::array<double, 2>& demand);

  [[nodiscard]] std::array<double, 2> state() const;

 private:
  [[nodiscard]] double command(double demand) const;

  AccommodationConfig config_;
  std::array<double, 2> amplitude_;
  std::optional<double> answered_;  // the demand that the last command answers, D
  std::optional<DelayedResponse> drive_;
};

}  // namespace tracking
