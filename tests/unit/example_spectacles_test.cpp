// The example pairs do what their names say: the bifocal's addition, the prism, the contact lenses' correction.
#include <gtest/gtest.h>

#include <array>

#include "lenses/lens_io/lens_io.hpp"
#include "lenses/trace.hpp"

namespace {

lenses::Spectacles example(const std::string& name) {
  return lenses::read_spectacles(VERGENCE_ASSETS "/spectacles/" + name + ".json");
}

lenses::TraceResult look(const lenses::Lens& lens, lenses::Side side, const glm::dvec3& direction,
                         const lenses::Eye& eye = {}) {
  lenses::TraceRequest request;
  request.lens = lens;
  request.side = side;
  request.direction = direction;
  request.eye = eye;
  lenses::TraceBatch batch;
  lenses::append_request(batch, request);
  return lenses::to_result(lenses::trace_reference(batch).front(), batch.rays.front(), true);
}

TEST(ExampleSpectacles, BifocalAddsTwoDioptresInItsSegment) {
  const auto pair = example("presbyopia_bifocal");
  for (const auto side : {lenses::Side::right, lenses::Side::left}) {
    const lenses::Lens& lens = pair.lens[static_cast<std::size_t>(side)];
    const auto far = look(lens, side, {0.0, 0.0, -1.0});
    EXPECT_NEAR(far.vergence.x, 0.0, 1e-3) << "radii are rounded to 0.1 um";
    EXPECT_LE(far.deviation, 1e-9);
    // The segment's middle before the pupil.
    lenses::Lens moved = lens;
    moved.fit.decentration = -lens.reference_points.near.value();
    const auto near = look(moved, side, {0.0, 0.0, -1.0});
    ASSERT_EQ(near.status, lenses::RayStatus::ok);
    // 2.00 D on a front of 5 D and 2.5 mm of glass are 2.04 D at the back vertex, 2.11 D at the pupil; the surfaces
    // are 4 degrees off the ray.
    EXPECT_NEAR(near.power, 2.11, 0.02);
    EXPECT_LE(near.astigmatism, 0.03);
  }
}

TEST(ExampleSpectacles, PrismTurnsTheEyesInAndApart) {
  const auto pair = example("prism");
  for (const auto side : {lenses::Side::right, lenses::Side::left}) {
    const auto result = look(pair.lens[static_cast<std::size_t>(side)], side, {0.0, 0.0, -1.0});
    const double out = side == lenses::Side::right ? 1.0 : -1.0;
    // Outgoing rays turn to the base; the lens's tilted back adds a hundredth of its prism.
    EXPECT_NEAR(result.object_direction.x / -result.object_direction.z, 0.03 * out, 4e-4);
    EXPECT_NEAR(result.object_direction.y / -result.object_direction.z, 0.01 * out, 2e-4);
    EXPECT_NEAR(result.power, 0.0, 0.02);
  }
}

TEST(ExampleSpectacles, ContactLensesCorrectTheMyopeOfSixDioptres) {
  const auto pair = example("myopia_contact_lenses");
  const auto wearer = lenses::read_wearer(VERGENCE_ASSETS "/wearers/myopia.json");
  for (const auto side : {lenses::Side::right, lenses::Side::left}) {
    const auto i = static_cast<std::size_t>(side);
    EXPECT_EQ(pair.lens[i].attached_to, lenses::Lens::AttachedTo::eye);
    const auto result = look(pair.lens[i], side, {0.0, 0.0, -1.0}, wearer.eye[i]);
    EXPECT_LE(glm::length(result.residual), 1e-3) << "radii are rounded to 0.1 um";
  }
}

}  // namespace
