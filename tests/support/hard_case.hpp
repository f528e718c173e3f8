// Requests through a centred lens in front of the default eye, and the closed forms they are held to.
#pragma once

#include "tests/support/both_engines.hpp"
#include "tests/support/coddington.hpp"
#include "tests/support/random_lens.hpp"

namespace support {

class HardCase : public BothEngines {
 protected:
  // 13 mm vertex distance, the pupil 16.05 mm behind the back vertex.
  static lenses::TraceRequest through(const lenses::Surface& front, const lenses::Surface& back,
                                      double thickness_mm = 3.0) {
    lenses::TraceRequest request;
    request.lens.emplace();
    request.lens->index = 1.5;
    request.lens->front = front;
    request.lens->back = back;
    request.lens->centre_thickness = 1e-3 * thickness_mm;
    request.lens->diameter = 0.07;
    return request;
  }
  static lenses::TraceRequest toward(lenses::TraceRequest request, double right_deg, double up_deg) {
    request.direction = tracking::direction_from_yaw_pitch(right_deg * kRadians, up_deg * kRadians);
    return request;
  }
  // A ray parallel to the lens's axis that meets the back at (x, y).
  static lenses::TraceRequest parallel(lenses::TraceRequest request, double x_mm, double y_mm) {
    request.lens->fit.decentration = {-1e-3 * x_mm, -1e-3 * y_mm};
    return request;
  }
  // Thick lens on its axis.
  static double axial_vergence(const lenses::TraceRequest& request, double front_curvature, double back_curvature) {
    const double n = request.lens->index;
    const double q = request.object_distance ? 1.0 / *request.object_distance : 0.0;
    const double after_front = (n - 1.0) * front_curvature - q;
    const double at_back = after_front / (1.0 - request.lens->centre_thickness / n * after_front);
    const double vertex = at_back + (1.0 - n) * back_curvature;
    return vertex / (1.0 - (request.lens->fit.vertex_distance + request.eye.entrance_pupil_depth) * vertex);
  }
  static void expect_axial(const lenses::TraceRequest& request, double front_curvature, double back_curvature) {
    const double v = axial_vergence(request, front_curvature, back_curvature);
    expect_vergence(trace(request), {v, 0.0, v});
  }
  static void expect_coddington(const lenses::TraceRequest& request, double up_deg) {
    const lenses::Lens& lens = *request.lens;
    const auto v = coddington_vergence(
        {lens.index, lens.centre_thickness, std::get<lenses::Sphere>(lens.front).curvature,
         std::get<lenses::Sphere>(lens.back).curvature, lens.fit.vertex_distance + request.eye.entrance_pupil_depth},
        up_deg * kRadians, request.object_distance ? 1.0 / *request.object_distance : 0.0);
    expect_vergence(trace(toward(request, 0.0, up_deg)), {v.sagittal, 0.0, v.tangential});
  }
};

}  // namespace support
