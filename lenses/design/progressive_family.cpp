#include "lenses/design/progressive_family.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace lenses {

double ProgressiveFamily::meridian_power(double v) const {
  const double t = std::clamp((v - config_.rise_start) / config_.rise_length, 0.0, 1.0);
  return config_.distance_power + config_.addition * t * t * t * (10.0 - 15.0 * t + 6.0 * t * t);
}

double ProgressiveFamily::sine_of_slope(double v) const {
  // The integral of S from t = 0: t^4 (5/2 - 3 t + t^2) up to 1, then S = 1.
  const auto rise = [&](double at) {
    const double t = (at - config_.rise_start) / config_.rise_length, c = std::clamp(t, 0.0, 1.0);
    return config_.rise_length * (c * c * c * c * (2.5 - 3.0 * c + c * c) + std::max(0.0, t - 1.0));
  };
  return (config_.distance_power * v + config_.addition * (rise(v) - rise(0.0))) / config_.power_per_curvature;
}

double ProgressiveFamily::meridian_height(double v) const {
  // Three-point Gauss-Legendre on 24 panels: beyond 1e-15 m for |v| <= 50 mm.
  constexpr int kPanels = 24;
  constexpr std::array<double, 3> kNodes{-0.7745966692414834, 0.0, 0.7745966692414834};
  constexpr std::array<double, 3> kWeights{5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};
  const double half = 0.5 * v / kPanels;
  double sum = 0.0;
  for (int panel = 0; panel < kPanels; ++panel) {
    for (std::size_t i = 0; i < kNodes.size(); ++i) {
      const double s = sine_of_slope(half * (2 * panel + 1 + kNodes[i]));
      sum += kWeights[i] * s / std::sqrt(1.0 - s * s);
    }
  }
  return half * sum;
}

double ProgressiveFamily::height(double x, double y) const {
  const double c = std::cos(config_.inset), s = std::sin(config_.inset), dy = y - config_.fitting_cross;
  const double across = c * x + s * dy;
  const double v = s * x - c * dy - config_.fitting_cross;
  const double to_distance = std::hypot(v - config_.distance_pole, across);
  const double to_near = std::hypot(v - config_.near_pole, across);
  const double u =
      config_.distance_pole + (config_.near_pole - config_.distance_pole) * to_distance / (to_distance + to_near);
  const double curvature = meridian_power(u) / config_.power_per_curvature, sine = sine_of_slope(u);
  // r cos(theta) - sqrt(r^2 - down^2 - across^2), written so that a curvature of zero is no special case.
  const double along = v - u, down = sine + curvature * along;
  const double rise = curvature * (along * along + across * across) + 2.0 * along * sine;
  return meridian_height(u) +
         rise / (std::sqrt(1.0 - sine * sine) + std::sqrt(1.0 - down * down - curvature * curvature * across * across));
}

}  // namespace lenses
