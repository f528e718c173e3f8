// Approximate defocus makes of a point light what geometrical optics says, wherever it falls among the pixels.
#include <gtest/gtest.h>

#include "render/vk/device.hpp"
#include "tests/support/point_light.hpp"

namespace {

using render::BlurAccuracy;
using render::BlurKernel;
using render::Mode;
using support::PointLight;
using support::Residual;

class AdofPointLight : public support::PointLightSuite {
 protected:
  // The mean picture's moments with the lamp at places a quarter of a pixel and more apart, over the 2 pixels that wide
  // blurs share.
  static support::Moments moments(const Residual& residual, Mode mode, const BlurAccuracy& blur) {
    const auto pair = support::bare_pair();
    const glm::dvec3 vergence = glm::dvec3(-1.0, 0.0, -1.0) / PointLight::kDistance;
    render::FrameConfig config;
    config.width = config.height = PointLight::kSize;
    config.mode = mode;
    config.keep_radiance = true;
    config.accuracy.blur = blur;
    support::Moments mean;
    constexpr int kPlaces = 4;
    for (int place = 0; place < kPlaces; ++place) {
      auto view = PointLight::view(pair, residual, vergence);
      const double pixel = PointLight::pixel(std::abs(residual.first));
      const glm::dvec2 shift = glm::dvec2(0.25 + 0.5 * place, 0.25 + 0.5 * ((3 * place) % kPlaces)) * pixel;
      view.view.fov.tan_left += shift.x;
      view.view.fov.tan_right -= shift.x;
      view.view.fov.tan_up += shift.y;
      view.view.fov.tan_down -= shift.y;
      const auto one =
          support::moments_of(renderer_->render(pair.model, {view}, config).views.front(), PointLight::kSize);
      mean.light += one.light / kPlaces;
      mean.centre += (one.centre + shift * glm::dvec2(-1.0, 1.0) / pixel) * (1.0 / kPlaces);
      mean.spread += one.spread * (1.0 / kPlaces);
    }
    return mean;
  }

  // All but the kernel: the lamp's square and the pixels' as they are drawn sharp.
  static void expect_pupils_moments(const Residual& residual, const BlurAccuracy& blur, double tolerance = 0.02) {
    SCOPED_TRACE(testing::Message() << residual.first << " " << residual.second << " D x " << residual.axis_deg
                                    << ", taps " << blur.taps << ", rate " << blur.rate);
    const auto sharp = moments(residual, Mode::pinhole, blur);
    const auto blurred = moments(residual, Mode::adof, blur);
    const auto ratios = support::spread_ratios(blurred, residual, sharp.spread);
    EXPECT_GE(ratios.x, 1.0 - tolerance);
    EXPECT_LE(ratios.y, 1.0 + tolerance);
    EXPECT_NEAR(blurred.light / sharp.light, 1.0, 0.01);
    EXPECT_NEAR(glm::length(blurred.centre - sharp.centre), 0.0, 0.05);
  }
};

TEST_F(AdofPointLight, HasThePupilsMomentsAtEveryResidualAndAxis) {
  for (const Residual& residual : support::point_light_residuals()) {
    expect_pupils_moments(residual, {});
  }
}

TEST_F(AdofPointLight, HasThePupilsMomentsAtEveryPixelsOwnRate) {
  for (const Residual& residual : {Residual{-1.0, -1.0, 0.0}, Residual{5.0, 2.0, 30.0}}) {
    expect_pupils_moments(residual, {.taps = 2048, .rate = 1});
  }
}

TEST_F(AdofPointLight, IsAGaussianOfThePupilsMoments) {
  // The picture ends 2.8 standard deviations from the lamp's edge: what lies beyond, 0.4 % of the light, is 3 % of the
  // variance.
  expect_pupils_moments({-1.0, -1.0, 0.0}, {.kernel = BlurKernel::gaussian}, 0.035);
}

}  // namespace
