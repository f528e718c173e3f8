// A bicubic B-spline through the noise of tabulated heights. A table rounded to 0.1 um on a grid of 0.5 mm, differenced
// twice, is noise of 0.17 D; a spline as smooth as the rounding allows brings that below a hundredth.
//
// Penalised least squares (Eilers and Marx 1996, P-splines): sum (z - s(x, y))^2 + w (int s_xxx^2 + int s_yyy^2). Third
// derivatives, because a lens's power, the second ones, must not be pulled toward zero. The weight w minimises Mallows'
// unbiased estimate of the risk, sum (z - s)^2 + 2 noise^2 freedom, where the noise is known.
#pragma once

#include <cstddef>
#include <optional>

#include "lenses/lens.hpp"
#include "lenses/sag_samples.hpp"

namespace lenses {

struct SplineFitConfig {
  std::optional<double> noise = {};  // standard deviation of the heights' error, m; absent: the samples' own
  std::size_t most_controls = 100;   // a direction, at least 4
  void validate() const;             // throws std::invalid_argument
};

struct SplineFit {
  BsplineHeightField surface;  // on the bounding box of the samples
  std::size_t samples = 0;
  double noise = 0.0;                             // as assumed, m
  double freedom = 0.0;                           // effective number of parameters
  double residual_rms = 0.0, residual_max = 0.0;  // m
  // What the noise leaves in the surface's second derivatives, root mean square within 0.9 of the ellipse in the
  // bounding box, 1/m: of the mean curvature, and of the difference of the principal curvatures where both are equal.
  double mean_curvature_noise = 0.0, curvature_difference_noise = 0.0;

  [[nodiscard]] double power_noise(double index) const { return (index - 1.0) * mean_curvature_noise; }           // D
  [[nodiscard]] double cylinder_noise(double index) const { return (index - 1.0) * curvature_difference_noise; }  // D
};

// Samples on a full grid, in any order, are solved exactly in one step; others by a sparse factorisation with at most
// 50 controls a direction. Throws std::invalid_argument with the reason when the samples do not define a surface.
[[nodiscard]] SplineFit fit_spline(const SagSamples& samples, const SplineFitConfig& config = {});

}  // namespace lenses
