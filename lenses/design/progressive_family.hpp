// A progressive surface in closed form: a one-parameter family of spheres whose curvature follows the wanted power down
// the meridian. Along the meridian (a curve with the curvature of the local sphere) the surface is umbilic; off it each
// point takes the sphere of the parameter u that a bipolar coordinate about two poles assigns to it, so the zones of
// constant power open like fans above and below the corridor.
//
// Coordinates: x to the nose, y up; metres. v runs down the meridian, v = -y where the inset is 0.
//   p(v) = distance_power + addition S((v - rise_start) / rise_length), S(t) = t^3 (10 - 15 t + 6 t^2) clamped
//   kappa = p / power_per_curvature, sin theta = integral of kappa from 0, z_m = integral of tan theta from 0
//   u = v_D + (v_N - v_D) d_D / (d_D + d_N), d_i the distance to the pole (0, v_i)
//   z = height at (x, v) of the sphere of curvature kappa(u) that touches the meridian at u
#pragma once

namespace lenses {

struct ProgressiveFamilyConfig {
  double distance_power = 5.0;         // of the surface, D
  double addition = 2.0;               // D
  double power_per_curvature = 0.6;    // n - 1 on the front, 1 - n on the eye side
  double rise_start = -0.005;          // v where the power begins to rise, m
  double rise_length = 0.018;          // m
  double distance_pole = -0.015;       // v, m
  double near_pole = 0.018;            // v, m
  double inset = 0.13962634015954636;  // turn of the near zone toward the nose about the fitting cross, rad (8 deg)
  double fitting_cross = 0.004;        // y, m
};

class ProgressiveFamily {
 public:
  explicit ProgressiveFamily(const ProgressiveFamilyConfig& config = {}) : config_(config) {}

  // Height over the lens plane, positive toward the eye, m; finite where the spheres reach.
  [[nodiscard]] double height(double x, double y) const;
  // Surface power on the meridian, D.
  [[nodiscard]] double meridian_power(double v) const;

 private:
  [[nodiscard]] double sine_of_slope(double v) const;
  [[nodiscard]] double meridian_height(double v) const;

  ProgressiveFamilyConfig config_;
};

}  // namespace lenses
