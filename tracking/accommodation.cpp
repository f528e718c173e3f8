#include "tracking/accommodation.hpp"

#include <algorithm>
#include <cmath>

namespace tracking {

std::optional<double> shared_demand(const std::array<double, 2>& demand) {
  std::optional<double> lesser;
  for (const double d : demand) {
    if (std::isfinite(d)) {
      lesser = std::min(lesser.value_or(d), d);
    }
  }
  return lesser;
}

double settled_response(const AccommodationConfig& config, double demand) {
  return std::max(0.0, config.tonic + config.slope * (demand - config.tonic));
}

Accommodation::Accommodation(const AccommodationConfig& config, const std::array<double, 2>& amplitude)
    : config_(config), amplitude_(amplitude) {}

double Accommodation::command(double demand) const {
  // Beyond what the better eye can do the drive would only have farther to come back.
  return std::min(settled_response(config_, demand), std::max(amplitude_[0], amplitude_[1]));
}

std::array<double, 2> Accommodation::step(double time, const std::array<double, 2>& demand) {
  const std::optional<double> lesser = shared_demand(demand);
  if (lesser && std::isfinite(time) && (!answered_ || std::abs(*lesser - *answered_) > config_.depth_of_focus)) {
    answered_ = lesser;
  }
  if (!answered_) {
    return state();
  }
  if (!drive_) {
    drive_.emplace(DelayedResponse::Config{config_.latency, config_.time_constant, config_.time_constant},
                   command(*answered_));
  }
  drive_->step(time, command(*answered_));
  return state();
}

std::array<double, 2> Accommodation::state() const {
  const double drive = drive_ ? drive_->value() : 0.0;
  return {std::min(drive, amplitude_[0]), std::min(drive, amplitude_[1])};
}

}  // namespace tracking
