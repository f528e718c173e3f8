// The wavefronts of a frame against the double-precision tracer's: small for the device, and exactly what is added.
#include "render/wavefront_error.hpp"

#include <gtest/gtest.h>

#include "lenses/lens_io/lens_io.hpp"
#include "render/vk/device.hpp"
#include "tests/support/lit_scene.hpp"

namespace {

using render::WavefrontReference;

std::optional<render::WavefrontError> error_of(const WavefrontReference& reference,
                                               const render::WavefrontPlanes& planes) {
  std::vector<double> power, astigmatism;
  reference.append_differences(planes, power, astigmatism);
  return render::wavefront_error(std::move(power), std::move(astigmatism));
}

class WavefrontErrorTest : public testing::Test {
 protected:
  static support::Seen seen(const lenses::Spectacles* spectacles, double half_tangent) {
    render::Scene scene = support::dark_scene();
    support::add_wall(scene, support::add_material(scene, support::unlit(glm::vec4(1.0F))), 0.1F, 0.0F, 0.8F, 0.3F);
    static render::vk::Device device;
    render::Renderer renderer(device, scene);
    return support::look(renderer, {.width = 70, .height = 50, .half_tangent = half_tangent, .spectacles = spectacles});
  }
};

TEST_F(WavefrontErrorTest, TheDeviceIsCloseAndWhatIsAddedIsFound) {
  const auto spectacles = lenses::read_spectacles(VERGENCE_ASSETS "/spectacles/presbyopia_bspline_sphere.json");
  const support::Seen frame = seen(&spectacles, 0.5);
  const WavefrontReference reference(frame.pair.model, frame.setup, 70, 50);
  const auto device = error_of(reference, frame.view.wavefront);
  ASSERT_TRUE(device);
  // What the engines are held to, ray for ray.
  EXPECT_LT(device->power_p99, 1e-3);
  EXPECT_LT(device->astigmatism_p99, 2e-3);
  EXPECT_GT(device->power_p99, 0.0) << "single precision is not double";
  render::WavefrontPlanes moved = frame.view.wavefront;
  for (std::size_t i = 0; i < moved.v_hh.size(); ++i) {
    moved.v_hh[i] += 0.25F;
    moved.v_vv[i] += 0.25F;
  }
  const auto shifted = error_of(reference, moved);
  EXPECT_NEAR(shifted->power_p99, 0.25, 1e-3);
  EXPECT_NEAR(shifted->astigmatism_p99, device->astigmatism_p99, 1e-5) << "power alone was moved";
}

// Far beyond the lens's rim and without one, V is that of the distance.
TEST_F(WavefrontErrorTest, WithoutALensTheDistanceIsAll) {
  const support::Seen bare = seen(nullptr, 0.25);
  const auto error = error_of(WavefrontReference(bare.pair.model, bare.setup, 70, 50), bare.view.wavefront);
  ASSERT_TRUE(error);
  EXPECT_LT(error->power_p99, 1e-6);
  EXPECT_LT(error->astigmatism_p99, 1e-6);
}

TEST_F(WavefrontErrorTest, NothingIsComparedWhereNothingIsSeen) {
  support::Seen bare = seen(nullptr, 0.25);
  std::ranges::fill(bare.view.wavefront.depth, -1.0F);
  EXPECT_FALSE(error_of(WavefrontReference(bare.pair.model, bare.setup, 70, 50), bare.view.wavefront));
}

// An even grid of the pixels gives nearly what all do.
TEST_F(WavefrontErrorTest, AGridStandsForAll) {
  const auto spectacles = lenses::read_spectacles(VERGENCE_ASSETS "/spectacles/presbyopia_bspline_sphere.json");
  const support::Seen frame = seen(&spectacles, 0.4);
  render::WavefrontPlanes planes = frame.view.wavefront;
  for (std::size_t i = 0; i < planes.v_hh.size(); ++i) {
    planes.v_hh[i] += 1e-4F * static_cast<float>(i % 70);
  }
  std::vector<double> power, astigmatism;
  WavefrontReference(frame.pair.model, frame.setup, 70, 50, 200).append_differences(planes, power, astigmatism);
  EXPECT_LE(power.size(), 200U);
  EXPECT_GE(power.size(), 100U);
  const auto some = render::wavefront_error(power, astigmatism);
  const auto all = error_of(WavefrontReference(frame.pair.model, frame.setup, 70, 50), planes);
  EXPECT_NEAR(some->power_p99, all->power_p99, 5e-4) << "a step of five columns";
}

}  // namespace
