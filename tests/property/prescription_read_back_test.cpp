// Random prescriptions, made into lenses by the design code and read back on the lensmeter, which is made of the tracer
// and shares nothing with the design code.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lenses/design/materials.hpp"
#include "lenses/design/prescription_lens.hpp"
#include "lenses/measure/power.hpp"
#include "lenses/measure/readings.hpp"
#include "lenses/measure/tolerance.hpp"
#include "lenses/measure/worn_map.hpp"
#include "tests/support/random_lens.hpp"

namespace {

using lenses::CylinderForm;
using lenses::LensRequest;
using lenses::LensSide;
using lenses::Prescription;
using lenses::ReferencePoint;
using lenses::Refraction;
using std::numbers::pi;

constexpr std::uint64_t kSeed = 42;
// What this project promises of a lens made from a prescription; a good lensmeter shows 0.01 D, 1 degree and 0.05 pd.
constexpr double kPower = 0.005, kAxis = 0.1 * pi / 180.0, kPrism = 0.01, kLeastCylinderWithAxis = 0.25;

Prescription random_prescription(support::Random& random) {
  Prescription rx;
  rx.sphere = random.uniform(-20.0, 15.0);
  rx.cylinder = random.chance(0.1) ? 0.0 : random.uniform(-6.0, 6.0);
  rx.axis = random.chance(0.1) ? pi : random.uniform(0.0, pi);
  if (random.chance(0.7)) {
    rx.prism.push_back({random.uniform(0.0, 10.0), random.uniform(0.0, 2.0 * pi)});
  }
  return rx;
}

LensRequest random_request(support::Random& random) {
  LensRequest request;
  request.prescription = random_prescription(random);
  const lenses::Material& material = lenses::materials()[random.pick(lenses::materials().size())];
  request.index = material.index;
  request.abbe = material.abbe;
  request.side = random.chance(0.5) ? lenses::Side::right : lenses::Side::left;
  request.toric = random.chance(0.5) ? lenses::ToricForm::tyre : lenses::ToricForm::barrel;
  request.front = random.chance(0.3) ? lenses::FrontDesign::aspheric : lenses::FrontDesign::spherical;
  return request;
}

std::string in_words(const LensRequest& request) {
  const Prescription& rx = request.prescription;
  std::string text = std::to_string(rx.sphere) + " " + std::to_string(rx.cylinder) + " x " +
                     std::to_string(rx.axis * 180.0 / pi) + ", index " + std::to_string(request.index);
  for (const lenses::Prism& prism : rx.prism) {
    text += ", prism " + std::to_string(prism.magnitude) + " at " + std::to_string(prism.base * 180.0 / pi);
  }
  return text;
}

void expect_power(const glm::dvec3& power, const Refraction& ordered) {
  const CylinderForm form = ordered.cylinder > 0.0 ? CylinderForm::plus : CylinderForm::minus;
  const Refraction read = sphere_cylinder(power, form);
  EXPECT_NEAR(read.sphere, ordered.sphere, kPower);
  EXPECT_NEAR(read.cylinder, ordered.cylinder, kPower);
  if (std::abs(ordered.cylinder) >= kLeastCylinderWithAxis) {
    EXPECT_NEAR(std::remainder(read.axis - ordered.axis, pi), 0.0, kAxis);
  }
}

void expect_prism(const glm::dvec2& prism, const Prescription& ordered) {
  const glm::dvec2 wanted = lenses::prism_vector(ordered.prism);
  EXPECT_NEAR(prism.x, wanted.x, kPrism);
  EXPECT_NEAR(prism.y, wanted.y, kPrism);
}

TEST(ReadBack, AThousandPrescriptions) {
  support::Random random(kSeed);
  for (int i = 0; i < 1000; ++i) {
    const LensRequest request = random_request(random);
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", prescription " + std::to_string(i) + ": " + in_words(request));
    const lenses::Lens lens = lenses::design_lens(request).lens;
    const lenses::LensReadings readings = read_lens_powers(lens, lenses::Lensmeter(lens));
    const auto* distance = readings.find(ReferencePoint::distance, LensSide::back);
    const auto* prism = readings.find(ReferencePoint::prism, LensSide::back);
    ASSERT_EQ(distance->reading.status, lenses::RayStatus::ok);
    ASSERT_EQ(prism->reading.status, lenses::RayStatus::ok);
    const Prescription& rx = request.prescription;
    expect_power(distance->reading.power, {rx.sphere, rx.cylinder, rx.axis});
    expect_prism(prism->reading.prism, rx);
    if (HasFailure()) {
      break;  // one prescription tells enough
    }
  }
}

// Additions from the front, where these designs' segments are. The order is for the distance portion's own reading.
TEST(ReadBack, BifocalAdditions) {
  support::Random random(kSeed + 1);
  for (int i = 0; i < 100; ++i) {
    LensRequest request = random_request(random);
    Prescription& rx = request.prescription;
    rx.sphere = random.uniform(-10.0, 6.0);
    rx.cylinder *= 0.5;
    rx.addition = random.uniform(0.75, 3.5);
    rx.prism.clear();
    request.design = lenses::LensDesign::bifocal;
    request.front = lenses::FrontDesign::spherical;
    request.segment = std::array{lenses::SegmentShape::ft28, lenses::SegmentShape::r24,
                                 lenses::SegmentShape::executive}[random.pick(3)];
    SCOPED_TRACE("seed " + std::to_string(kSeed + 1) + ", prescription " + std::to_string(i) + ": " +
                 in_words(request) + ", add " + std::to_string(rx.addition));
    const lenses::Lens lens = lenses::design_lens(request).lens;
    const lenses::LensReadings readings = read_lens_powers(lens, lenses::Lensmeter(lens));
    expect_power(readings.find(ReferencePoint::distance, LensSide::back)->reading.power,
                 {rx.sphere, rx.cylinder, rx.axis});
    EXPECT_EQ(readings.addition_side, LensSide::front);
    ASSERT_TRUE(readings.addition.has_value());
    EXPECT_NEAR(*readings.addition, rx.addition, kPower);
    EXPECT_EQ(lens_class_of(lens), lenses::LensClass::multifocal);
    if (HasFailure()) {
      break;
    }
  }
}

TEST(ReadBack, ContactLenses) {
  support::Random random(kSeed + 2);
  for (int i = 0; i < 50; ++i) {
    LensRequest request;
    request.prescription.sphere = random.uniform(-10.0, 8.0);
    request.design = lenses::LensDesign::contact;
    request.contact = random.chance(0.5) ? lenses::ContactKind::soft : lenses::ContactKind::rigid;
    SCOPED_TRACE(in_words(request));
    const lenses::DesignedLens designed = lenses::design_lens(request);
    const lenses::Lens& lens = designed.lens;
    const lenses::LensReadings readings = read_lens_powers(lens, lenses::Lensmeter(lens));
    const Prescription& target = lens.order->compensated ? *lens.order->compensated : lens.order->ordered;
    expect_power(readings.find(ReferencePoint::distance, LensSide::back)->reading.power,
                 {target.sphere, target.cylinder, target.axis});
  }
}

// What the design code says a lensmeter will read is what it reads, and the verdict is by that.
TEST(ReadBack, CompensatedLensesPassTheirVerification) {
  support::Random random(kSeed + 3);
  for (int i = 0; i < 50; ++i) {
    LensRequest request = random_request(random);
    request.prescription.sphere = random.uniform(-8.0, 6.0);
    request.prescription.prism.clear();
    request.as_worn = true;
    SCOPED_TRACE("seed " + std::to_string(kSeed + 3) + ", prescription " + std::to_string(i) + ": " +
                 in_words(request));
    const lenses::DesignedLens designed = lenses::design_lens(request);
    const lenses::Lens& lens = designed.lens;
    ASSERT_TRUE(lens.order && lens.order->compensated);
    const lenses::LensReadings readings = read_lens_powers(lens, lenses::Lensmeter(lens));
    const Prescription& target = *lens.order->compensated;
    expect_power(readings.find(ReferencePoint::distance, LensSide::back)->reading.power,
                 {target.sphere, target.cylinder, target.axis});
    // And before the eye that looks through the distance point the lens is what was ordered.
    const lenses::WornLens worn(lens, request.side, {});
    const lenses::WornReading straight = worn.read(worn.gaze_through(distance_point(lens)), 0.0);
    ASSERT_EQ(straight.status, lenses::RayStatus::ok);
    const Prescription& rx = request.prescription;
    expect_power(straight.power, {rx.sphere, rx.cylinder, rx.axis});
    const lenses::Verdict verdict =
        judge(lenses::tolerance_standards().front(), lens_class_of(lens), readings, *lens.order);
    EXPECT_TRUE(verdict.against_compensated);
    for (const lenses::Check& check : verdict.checks) {
      EXPECT_TRUE(check.pass) << check.tolerance << ": " << check.measured.value_or(0.0) << " for " << check.target;
    }
    if (HasFailure()) {
      break;
    }
  }
}

}  // namespace
