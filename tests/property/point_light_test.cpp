// Distributed rays make of a point light what geometrical optics says: the pupil's disc, stretched by the residual.
#include <gtest/gtest.h>

#include "render/vk/device.hpp"
#include "tests/support/point_light.hpp"

namespace {

using support::PointLight;
using support::Residual;

class PointLightTest : public support::PointLightSuite {
 protected:
  static render::RenderedView distributed(const support::WornPair& pair, const render::ViewSetup& view, int samples) {
    render::FrameConfig config;
    config.width = config.height = PointLight::kSize;
    config.mode = render::Mode::dof;
    config.samples = samples;
    config.bare = true;
    config.keep_radiance = true;
    return renderer_->render(pair.model, {view}, config).views.front();
  }
};

// The image of one point is where the pupil's points s come to lie: R s. A disc of diameter a has the variance (a/4)^2
// in every direction. 256 samples for each of the lamp's 64 pixels are 16,000 rays: were they independent, light and
// variances would be good to 0.8 %.
TEST_F(PointLightTest, HasThePupilsMomentsAtEveryResidualAndAxis) {
  const auto pair = support::bare_pair();
  const glm::dvec3 vergence = glm::dvec3(-1.0, 0.0, -1.0) / PointLight::kDistance;
  const double lamp_pixels = 4.0 * PointLight::kHalfLamp * PointLight::kHalfLamp;
  for (const Residual& residual : support::point_light_residuals()) {
    SCOPED_TRACE(testing::Message() << residual.first << " " << residual.second << " D x " << residual.axis_deg);
    const auto view = distributed(pair, PointLight::view(pair, residual, vergence), 256);
    const auto moments = support::moments_of(view, PointLight::kSize);
    const auto ratios = support::spread_ratios(moments, residual, support::sharp_spread());
    EXPECT_GE(ratios.x, 0.98);
    EXPECT_LE(ratios.y, 1.02);
    EXPECT_NEAR(moments.light / lamp_pixels, 1.0, 0.015);
    EXPECT_NEAR(glm::length(moments.centre), 0.0, 0.1);
  }
}

// The same through a lens, whose astigmatism is not along the eye's: what counts is their sum. The lamp's own size is
// that of its image, which chief rays in double precision tell.
TEST_F(PointLightTest, HasThePupilsMomentsThroughASpherocylindricalLens) {
  lenses::Lens lens;
  lens.index = 1.5;
  lens.centre_thickness = 0.002;
  lens.front = lenses::Sphere{6.0};
  lens.back = lenses::Torus{12.0, 15.0, 30.0 * support::kDegree};  // about -3.00 and -4.50 D
  const lenses::Spectacles spectacles{"", {lens, lens}, glm::dvec3(1.0)};
  const auto pair = support::wear(lenses::Wearer{}, &spectacles, tracking::Pose{});
  const auto sight = [&](const glm::dvec2& slope) {
    return lenses::f64::trace_sight_line(lenses::f64::Table{pair.model.table}, pair.model.lens[pair.lens[0]],
                                         pair.eyes[0].eye, glm::dmat3(1.0), glm::normalize(glm::dvec3(slope, -1.0)),
                                         glm::dvec2(0.0), glm::dvec2(0.0));
  };
  const auto line = sight(glm::dvec2(0.0));
  const auto transfer = lenses::f64::sight_line_transfer(pair.model.lens[pair.lens[0]], line);
  int status = line.status;
  const glm::dvec3 vergence =
      lenses::f64::sight_line_vergence(transfer, 1.0 / (PointLight::kDistance + line.start.z), status);
  ASSERT_EQ(status, lenses::f64::kStatusOk);
  // Where the lamp's plane is met, by slope at the eye: lamp = object * slope.
  const auto on_wall = [&](const glm::dvec2& slope) {
    const auto ray = sight(slope);
    const double t = (-PointLight::kDistance - ray.start.z) / ray.direction_object.z;
    return glm::dvec2(ray.start + t * ray.direction_object);
  };
  const double h = 1e-4;
  const glm::dmat2 object(on_wall({h, 0.0}) / h, on_wall({0.0, h}) / h);
  const glm::dmat2 magnified = PointLight::kDistance * glm::inverse(object);
  const glm::dmat2 own = PointLight::kHalfLamp * PointLight::kHalfLamp / 3.0 * magnified * glm::transpose(magnified) +
                         glm::dmat2(1.0 / 12.0);
  for (const Residual& residual : {Residual{0.5, 0.25, 70.0}, Residual{-2.0, -1.0, 120.0}, Residual{5.0, 2.0, 15.0}}) {
    SCOPED_TRACE(testing::Message() << residual.first << " " << residual.second << " D x " << residual.axis_deg);
    const auto view = distributed(pair, PointLight::view(pair, residual, vergence), 256);
    const auto ratios = support::spread_ratios(support::moments_of(view, PointLight::kSize), residual, own);
    EXPECT_GE(ratios.x, 0.98);
    EXPECT_LE(ratios.y, 1.02);
  }
}

}  // namespace
