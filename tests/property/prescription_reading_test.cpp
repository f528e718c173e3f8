// Random prescriptions, made into lenses, read as they were ordered.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "lenses/design/lens_shape.hpp"
#include "lenses/design/materials.hpp"
#include "lenses/design/prescription_lens.hpp"

namespace {

using lenses::LensRequest;
namespace design = lenses::design;

constexpr unsigned kSeed = 20260722;
constexpr double kPi = std::numbers::pi;

class RandomOrders {
 public:
  LensRequest next() {
    LensRequest r;
    r.prescription = {uniform(-20.0, 15.0), uniform(-6.0, 6.0), uniform(0.0, kPi), 0.0, {}};
    if (uniform(0.0, 1.0) < 0.5) {
      r.prescription.prism.push_back({uniform(0.0, 10.0), uniform(0.0, 2.0 * kPi)});
    }
    const auto materials = lenses::materials();
    const auto& material = materials[static_cast<std::size_t>(uniform(0.0, static_cast<double>(materials.size())))];
    r.index = material.index;
    r.abbe = material.abbe;
    r.toric = uniform(0.0, 1.0) < 0.5 ? lenses::ToricForm::tyre : lenses::ToricForm::barrel;
    r.side = uniform(0.0, 1.0) < 0.5 ? lenses::Side::right : lenses::Side::left;
    return r;
  }

 private:
  double uniform(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random_); }

  std::mt19937 random_{kSeed};
};

// Smallest turn between two axes.
double axis_difference(double a, double b) {
  const double d = std::fmod(std::abs(a - b), kPi);
  return std::min(d, kPi - d);
}

TEST(RandomPrescription, IsReadAsOrdered) {
  RandomOrders orders;
  int made = 0;
  for (int i = 0; i < 300; ++i) {
    const LensRequest request = orders.next();
    const lenses::Prescription& p = request.prescription;
    SCOPED_TRACE("seed " + std::to_string(kSeed) + " order " + std::to_string(i) + ": " + std::to_string(p.sphere) +
                 " " + std::to_string(p.cylinder) + " x " + std::to_string(p.axis * 180.0 / kPi) + " index " +
                 std::to_string(request.index));
    const lenses::DesignedLens designed = lenses::design_lens(request);
    ++made;
    const auto reading = design::reading_at_back(design::LensShape(designed.lens), {0.0, 0.0});
    ASSERT_TRUE(reading);
    const lenses::Prescription read = design::to_prescription(*reading, p.cylinder > 0.0);
    // What an instrument of the trade cannot tell apart, with room.
    EXPECT_NEAR(read.sphere, p.sphere, 1e-6);
    EXPECT_NEAR(read.cylinder, p.cylinder, 1e-6);
    if (std::abs(p.cylinder) >= 0.25) {
      EXPECT_LT(axis_difference(read.axis, p.axis), 1e-6);
    }
    const glm::dvec2 prism = reading->prism - design::prism_vector(p.prism);
    EXPECT_LT(std::hypot(prism.x, prism.y), 1e-6);
    EXPECT_GT(designed.thinnest_edge, 0.00099);
    EXPECT_GE(designed.lens.centre_thickness, 0.0012 - 1e-12);
  }
  EXPECT_EQ(made, 300);
}

}  // namespace
