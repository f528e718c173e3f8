#include "tracking/fixation_distance.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace tracking {
namespace {

constexpr double kAgreement = 3.0;  // standard errors
constexpr double kSameDepth = 0.2;  // D: less than the depth of focus, more than a surface's slope within the noise

}  // namespace

std::optional<VergenceEstimate> vergence_estimate(const Line& right, const Line& left, double direction_noise) {
  const glm::dvec3 sum = right.direction + left.direction;
  const glm::dvec3 baseline = right.origin - left.origin;
  const double length = glm::length(sum);
  if (!(length > 1e-6) || !std::isfinite(length + glm::dot(baseline, baseline))) {
    return std::nullopt;
  }
  const glm::dvec3 gaze = sum / length;
  const glm::dvec3 across = baseline - glm::dot(baseline, gaze) * gaze;
  const double across2 = glm::dot(across, across);
  if (!(across2 > 1e-8)) {  // 0.1 mm
    return std::nullopt;
  }
  const glm::dvec3 difference = left.direction - right.direction;
  VergenceEstimate estimate;
  estimate.dioptres = glm::dot(difference, across) / across2;
  // What is left is the lines' passing each other above and below; it has the noise of two directions on one axis.
  const double noise = std::numbers::sqrt2 * direction_noise;
  const double misfit = glm::length(difference - estimate.dioptres * across);
  estimate.sigma = std::max(noise, misfit) / std::sqrt(across2);
  return estimate;
}

FixationDistance fixation_distance(std::span<const double> scene, const std::optional<VergenceEstimate>& vergence) {
  using From = FixationDistance::From;
  if (!vergence) {
    return scene.empty() ? FixationDistance{} : FixationDistance{std::max(0.0, scene.front()), From::scene};
  }
  const auto miss = [&](double dioptres) { return std::abs(dioptres - vergence->dioptres); };
  const double tolerance = kAgreement * vergence->sigma;
  if (!scene.empty() && miss(scene.front()) <= tolerance / kAgreement) {
    return {std::max(0.0, scene.front()), From::scene};
  }
  const auto nearest = std::ranges::min_element(scene, {}, miss);
  if (nearest != scene.end() && miss(*nearest) <= tolerance) {
    return {std::max(0.0, *nearest), From::scene};
  }
  return {std::max(0.0, vergence->dioptres), From::vergence};
}

double DepthHold::see(double time, double dioptres, bool jumped) {
  if (!std::isfinite(time) || !std::isfinite(dioptres) || (started_ && time < time_)) {
    return value_;
  }
  if (!started_ || jumped) {
    started_ = true;
    has_candidate_ = false;
    value_ = goal_ = dioptres;
    time_ = time;
    return value_;
  }
  value_ = goal_ + (value_ - goal_) * std::exp(-(time - time_) / time_constant_);
  time_ = time;
  if (std::abs(dioptres - goal_) <= kSameDepth) {
    goal_ = dioptres;
    has_candidate_ = false;
  } else if (!has_candidate_ || std::abs(dioptres - candidate_) > kSameDepth) {
    has_candidate_ = true;
    candidate_ = dioptres;
    candidate_since_ = time;
  } else if (time - candidate_since_ >= dwell_) {
    goal_ = dioptres;
    has_candidate_ = false;
  }
  return value_;
}

}  // namespace tracking
