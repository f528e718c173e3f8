// A progressive front surface in closed form: a one-parameter family of spheres whose radius follows the wanted power
// down the meridian. Along the meridian (a curve with the curvature of the local sphere) the surface is umbilic; off it
// each point takes the sphere of the parameter u that a bipolar coordinate about two poles assigns to it, so the zones
// of constant power open like fans above and below the corridor.
//
// Coordinates: as the viewer who faces the wearer sees a right lens, x to the nose, y up; metres. v = -y.
//   p(v) = distance_power + addition S((v - v_start) / corridor), S(t) = t^3 (10 - 15 t + 6 t^2) clamped
//   kappa = p / (n - 1), r = 1 / kappa, sin theta = integral of kappa from 0, z_m = integral of tan theta from 0
//   sphere centre (xi, zeta): xi = v - r sin theta, zeta = z_m + r cos theta
//   u = v_D + (v_N - v_D) d_D / (d_D + d_N), d_i the distance to the pole (0, v_i)
//   z = zeta(u) - sqrt(r(u)^2 - (v - xi(u))^2 - x^2)
#pragma once

namespace assets {

struct ProgressiveConfig {
  double distance_power = 5.0;  // of the surface, D
  double addition = 2.0;        // D
  double index = 1.6;
  double corridor_start = -0.005;      // v where the power begins to rise, m
  double corridor_length = 0.018;      // m
  double distance_pole = -0.015;       // v, m
  double near_pole = 0.018;            // v, m
  double inset = 0.13962634015954636;  // turn of the near zone toward the nose about the fitting cross, rad (8 deg)
  double fitting_cross = 0.004;        // y, m
};

class ProgressiveSurface {
 public:
  explicit ProgressiveSurface(const ProgressiveConfig& config = {}) : config_(config) {}

  // Height over the lens plane, positive toward the eye; m.
  [[nodiscard]] double height(double x, double y) const;
  // Surface power on the meridian, D.
  [[nodiscard]] double meridian_power(double v) const;

 private:
  [[nodiscard]] double sine_of_slope(double v) const;
  [[nodiscard]] double meridian_height(double v) const;

  ProgressiveConfig config_;
};

}  // namespace assets
