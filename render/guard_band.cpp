#include "render/guard_band.hpp"

#include <algorithm>
#include <cmath>

namespace render {

double largest_blur(const lenses::f64::Table& table, const EyeOptics& eye, Viewing viewing, double nearest) {
  const glm::dvec3 ahead(0.0, 0.0, -1.0);
  const glm::dmat3 turn = lenses::f64::eye_turn(static_cast<int>(viewing), ahead, ahead);
  const lenses::f64::SightLine line =
      lenses::f64::trace_sight_line(table, eye.lens, eye.eye, turn, ahead, glm::dvec2(0.0), glm::dvec2(0.0));
  const bool through = line.status == lenses::f64::kStatusOk && eye.lens.glass.w != 0.0;
  double largest = 0.0;
  for (const double q : {0.0, 1.0 / nearest}) {
    glm::dvec3 vergence(-q, 0.0, -q);
    if (through) {
      int status = lenses::f64::kStatusOk;
      vergence = lenses::f64::sight_line_vergence(lenses::f64::sight_line_transfer(eye.lens, line), q, status);
      if (status != lenses::f64::kStatusOk) {
        continue;  // the object is imaged into the pupil itself: no blur is its bound
      }
    }
    for (const double accommodation : {0.0, eye.eye.excess.w}) {
      largest = std::max(largest, lenses::f64::eye_response(vergence, eye.eye, accommodation).blur.x);
    }
  }
  return largest;
}

int guard_pixels(double blur_rad, const tracking::FieldOfView& fov, int width, int height) {
  const double steepest = std::max({fov.tan_left, fov.tan_right, fov.tan_down, fov.tan_up});
  const double pixels_a_tangent =
      std::max(width / (fov.tan_left + fov.tan_right), height / (fov.tan_down + fov.tan_up));
  // d(tan) = (1 + tan^2) d(angle)
  const double pixels = blur_rad * pixels_a_tangent * (1.0 + steepest * steepest);
  return static_cast<int>(std::ceil(std::min(pixels, std::min(width, height) / 8.0)));
}

}  // namespace render
