// Bifocals: where the segment lies, its addition, its image jump, and how its edge meets the rest.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lenses/design/lens_shape.hpp"
#include "lenses/design/prescription_lens.hpp"
#include "lenses/design/surface_making.hpp"
#include "lenses/design/worn_power.hpp"

namespace {

using lenses::LensRequest;
using lenses::SegmentShape;
namespace design = lenses::design;

struct Type {
  const char* name;
  SegmentShape shape;
  double top_to_centre;  // of the segment's own optical centre, m
};

class Bifocal : public testing::TestWithParam<Type> {
 protected:
  [[nodiscard]] static LensRequest request(lenses::Side side = lenses::Side::right) {
    LensRequest r;
    r.prescription = {1.0, -0.5, 0.5, 2.5, {}};
    r.design = lenses::LensDesign::bifocal;
    r.segment = GetParam().shape;
    r.side = side;
    r.fit.pantoscopic_tilt = r.fit.wrap = 0.0;
    return r;
  }
};

double mean(const design::PointPower& p) {
  return 0.5 * (p.power[0][0] + p.power[1][1]);
}

TEST_P(Bifocal, HasTheAdditionAsALensmeterReadsItOnTheFront) {
  const lenses::DesignedLens d = lenses::design_lens(request());
  const design::LensShape shape(d.lens);
  const auto near = design::reading_at_front(shape, *d.lens.reference_points.near);
  const auto distance = design::reading_at_front(shape, *d.lens.reference_points.distance);
  ASSERT_TRUE(near && distance);
  EXPECT_NEAR(mean(*near) - mean(*distance), 2.5, 1e-6);
  EXPECT_NEAR(d.verification.sphere, 1.0, 1e-6);
  EXPECT_NEAR(d.verification.cylinder, -0.5, 1e-6);
}

// Across the segment's top the image jumps by the addition times the distance to the segment's optical centre, towards
// it: the base of the segment's prism there.
TEST_P(Bifocal, ImageJumpsByAdditionTimesDistanceToTheOpticalCentre) {
  const lenses::DesignedLens d = lenses::design_lens(request());
  const design::SegmentLayout layout = design::segment_layout(request());
  const double x = layout.optical_centre.x;
  const design::LensShape shape(d.lens);
  // The prism of the front alone on both sides of the edge: gradients times (n - 1).
  const glm::dvec2 above = shape.front({x, layout.top + 1e-9}).gradient;
  const glm::dvec2 below = shape.front({x, layout.top - 1e-9}).gradient;
  const double jump = -100.0 * (d.lens.index - 1.0) * (below.y - above.y);
  // Base down, in prism dioptres; 3 % for slopes that are no longer small.
  EXPECT_NEAR(jump, -100.0 * 2.5 * GetParam().top_to_centre, 0.03 * 3.0);
  EXPECT_NEAR(layout.top - layout.optical_centre.y, GetParam().top_to_centre, 1e-12);
}

// The same for the traced eye that looks over the edge: the last line of sight above it against the first below.
TEST_P(Bifocal, JumpIsWhatTheEngineTraces) {
  const lenses::DesignedLens d = lenses::design_lens(request());
  const design::SegmentLayout layout = design::segment_layout(request());
  const auto seen = [&](double y) { return design::worn_power(d.lens, {}, {layout.optical_centre.x, y}); };
  const auto in_distance = [&](double y) { return seen(y) && mean(*seen(y)) < 2.0; };
  const auto in_segment = [&](double y) { return seen(y) && mean(*seen(y)) > 2.0; };
  // Lines that meet the ledge pass neither way; each side's end is sought for itself.
  double above = 0.5 * layout.top;
  double below = 1.2 * layout.top;
  double end_above = below;
  double end_below = above;
  ASSERT_TRUE(in_distance(above) && in_segment(below));
  for (int i = 0; i < 50; ++i) {
    const double a = 0.5 * (above + end_above);
    (in_distance(a) ? above : end_above) = a;
    const double b = 0.5 * (below + end_below);
    (in_segment(b) ? below : end_below) = b;
  }
  EXPECT_LT(above - below, 1e-4) << "the ledge hides no more";
  // Under the magnification of the lens's shape, and for slopes that are no longer small: 6 %.
  const double expected = -100.0 * 2.5 * GetParam().top_to_centre;
  EXPECT_NEAR(seen(below)->prism.y - seen(above)->prism.y, expected, 0.02 + 0.06 * std::abs(expected));
}

TEST_P(Bifocal, SegmentLiesTowardsTheNose) {
  const lenses::DesignedLens right = lenses::design_lens(request(lenses::Side::right));
  const lenses::DesignedLens left = lenses::design_lens(request(lenses::Side::left));
  EXPECT_LT(right.lens.reference_points.near->x, 0.0);
  EXPECT_GT(left.lens.reference_points.near->x, 0.0);
  EXPECT_LT(right.lens.reference_points.near->y, -0.005);
}

TEST_P(Bifocal, BoundaryIsTheSegmentsOutline) {
  const lenses::DesignedLens d = lenses::design_lens(request());
  const auto& front = std::get<lenses::SegmentedSurface>(d.lens.front);
  double top = -1.0;
  double left = 1.0;
  double right = -1.0;
  for (const glm::dvec2& p : front.boundary) {
    top = std::max(top, p.y);
    left = std::min(left, p.x);
    right = std::max(right, p.x);
  }
  EXPECT_NEAR(top, -0.005, 1e-6);
  const double width = right - left;
  switch (GetParam().shape) {
    case SegmentShape::ft28:
      EXPECT_NEAR(width, 0.028, 2e-5) << "a polygon of 120 sides";
      break;
    case SegmentShape::r24:
      EXPECT_NEAR(width, 0.024, 2e-5);
      break;
    case SegmentShape::executive:
      EXPECT_GT(width, 0.1);
      break;
  }
}

// Round: no ledge. Flat-top: a ledge along the straight edge only, the segment standing proud. Executive: none where
// the line passes the segment's centre.
TEST_P(Bifocal, LedgeIsWhereTheTypeHasIt) {
  const lenses::DesignedLens d = lenses::design_lens(request());
  const design::LensShape shape(d.lens);
  const design::SegmentLayout layout = design::segment_layout(request());
  const auto step_at = [&](const glm::dvec2& p, const glm::dvec2& outwards) {
    return shape.front(p + 1e-7 * outwards).z - shape.front(p - 1e-7 * outwards).z;
  };
  const double ledge = step_at({layout.optical_centre.x, layout.top}, {0.0, 1.0});
  // The two spheres meet along a circle about their common normal, which leans by up to 0.2 from the lens axis.
  constexpr double kFlush = 5e-5;
  if (GetParam().shape == SegmentShape::ft28) {
    const double curvatures = 2.5 / (d.lens.index - 1.0);
    EXPECT_NEAR(ledge, 0.5 * curvatures * (0.014 * 0.014 - 0.005 * 0.005), 0.2 * 0.0004) << "upright spheres";
  } else {
    EXPECT_NEAR(ledge, 0.0, kFlush);
  }
  if (layout.radius > 0.0) {
    for (const double a : {200.0, 270.0, 340.0}) {
      const double radians = a * std::numbers::pi / 180.0;
      const glm::dvec2 out(std::cos(radians), std::sin(radians));
      EXPECT_NEAR(step_at(layout.optical_centre + layout.radius * 0.9999 * out, out), 0.0, kFlush);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Types, Bifocal,
                         testing::Values(Type{"ft28", SegmentShape::ft28, 0.005}, Type{"r24", SegmentShape::r24, 0.012},
                                         Type{"executive", SegmentShape::executive, 0.0}),
                         [](const auto& instance) { return std::string(instance.param.name); });

}  // namespace
