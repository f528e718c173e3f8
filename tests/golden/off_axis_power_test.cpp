// Power on the vertex sphere of four single vision lenses, known to four decimals: object at infinity, the eye turned
// about a centre 27 mm behind the back vertex.
#include <gtest/gtest.h>

#include "tests/support/random_lens.hpp"
#include "tests/support/sight.hpp"

namespace {

struct OffAxis {
  const char* name;
  double back_vertex_power, index, front_power;  // D
  double thickness_mm, rotation_deg;
  double tangential, sagittal;  // D
};

class OffAxisPower : public testing::TestWithParam<OffAxis> {};

constexpr double kVertexSphere = 0.027;  // m

// The entrance pupil in the centre of rotation: the chief ray of the turned eye, V at its centre.
support::Sight chief_ray(const OffAxis& c) {
  lenses::Lens lens;
  lens.index = c.index;
  lens.centre_thickness = 1e-3 * c.thickness_mm;
  lens.diameter = 0.08;
  const double front_at_back = c.front_power / (1.0 - lens.centre_thickness * c.front_power / c.index);
  lens.front = lenses::Sphere{c.front_power / (c.index - 1.0)};
  lens.back = lenses::Sphere{(c.back_vertex_power - front_at_back) / (1.0 - c.index)};
  lenses::TraceRequest request;
  lens.fit.vertex_distance = kVertexSphere - request.eye.entrance_pupil_depth;
  request.lens = lens;
  const double turn = c.rotation_deg * support::kRadians;
  request.direction = {0.0, std::sin(turn), -std::cos(turn)};
  return support::Sight(request);
}

// From the centre of rotation back to the vertex sphere, whose radius every chief ray crosses at right angles.
double on_vertex_sphere(double at_centre) {
  return at_centre / (1.0 + kVertexSphere * at_centre);
}

TEST_P(OffAxisPower, AgreesWithTheTable) {
  const support::Sight sight = chief_ray(GetParam());
  ASSERT_TRUE(sight.ok());
  constexpr double kRounding = 5e-5 + 1e-7;  // of the fourth decimal
  // The eye turned up: the meridian of the turn is vertical.
  EXPECT_NEAR(on_vertex_sphere(sight.result.vergence.z), GetParam().tangential, kRounding);
  EXPECT_NEAR(on_vertex_sphere(sight.result.vergence.x), GetParam().sagittal, kRounding);
  EXPECT_NEAR(sight.result.vergence.y, 0.0, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Lenses, OffAxisPower,
                         testing::Values(OffAxis{"minus_5", -5.0, 1.498, 3.0, 2.0, 30.0, -5.0317, -4.8879},
                                         OffAxis{"plus_4", 4.0, 1.498, 8.0, 4.5, 30.0, 4.0364, 3.8684},
                                         OffAxis{"minus_8", -8.0, 1.666, 1.5, 1.2, 25.0, -8.4167, -7.9670},
                                         OffAxis{"plus_6", 6.0, 1.586, 9.0, 6.0, 25.0, 6.3435, 5.9435}),
                         [](const auto& instance) { return std::string(instance.param.name); });

}  // namespace
