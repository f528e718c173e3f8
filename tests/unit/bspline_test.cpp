// The change of a B-spline to power-basis cells.
#include "lenses/bspline.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "lenses/lens_model.hpp"
#include "tests/support/de_boor.hpp"

namespace {

using support::Random;

constexpr std::uint64_t kSeed = 1978;

double value(const std::array<double, 4>& polynomial, double s) {
  return ((polynomial[3] * s + polynomial[2]) * s + polynomial[1]) * s + polynomial[0];
}

TEST(Cells, SkipRepeatedKnots) {
  const std::vector<double> knots{0, 0, 0, 0, 1, 1, 2, 2, 2, 5, 5, 5, 5};
  const lenses::Cells cells = lenses::cells_of(knots);
  EXPECT_EQ(cells.breaks, (std::vector<double>{0, 1, 2, 5}));
  EXPECT_EQ(cells.first_control, (std::vector<std::size_t>{0, 2, 5}));
}

TEST(Cells, OfUnclampedKnotsStartAtTheFourth) {
  const lenses::Cells cells = lenses::cells_of(std::vector<double>{-3, -2, -1, 0, 1, 2, 3, 4, 5});
  EXPECT_EQ(cells.breaks, (std::vector<double>{0, 1, 2}));
  EXPECT_EQ(cells.first_control, (std::vector<std::size_t>{0, 1}));
}

TEST(Cells, NeedAnInterval) {
  EXPECT_THROW(static_cast<void>(lenses::cells_of(std::vector<double>{0, 0, 0, 1, 1, 2, 2, 2})), std::invalid_argument);
}

TEST(CellBasis, IsAPositivePartitionOfUnity) {
  Random random(kSeed);
  for (int trial = 0; trial < 100; ++trial) {
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", trial " << trial);
    const auto knots = support::uneven_knots(random, -2.0, 7.0, 2 + random.pick(10));
    const lenses::Cells cells = lenses::cells_of(knots);
    for (std::size_t cell = 0; cell < cells.count(); ++cell) {
      const auto basis = lenses::cell_basis(knots, cells, cell);
      for (int power = 0; power < 4; ++power) {
        double sum = 0.0;
        for (const auto& b : basis) {
          sum += b[static_cast<std::size_t>(power)];
        }
        EXPECT_NEAR(sum, power == 0 ? 1.0 : 0.0, 1e-12);
      }
      for (const double s : {0.0, 0.1, 0.5, 0.77, 1.0}) {
        for (const auto& b : basis) {
          EXPECT_GE(value(b, s), -1e-12);
        }
      }
    }
  }
}

TEST(CellBasis, OfUniformKnotsIsTheTextbookOne) {
  const std::vector<double> knots{0, 1, 2, 3, 4, 5, 6, 7};
  const auto basis = lenses::cell_basis(knots, lenses::cells_of(knots), 0);
  const std::array<std::array<double, 4>, 4> six_times{{{1, -3, 3, -1}, {4, 0, -6, 3}, {1, 3, 3, -3}, {0, 0, 0, 1}}};
  for (std::size_t b = 0; b < 4; ++b) {
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_NEAR(6.0 * basis[b][k], six_times[b][k], 1e-14);
    }
  }
}

lenses::f64::SurfacePoint point_of(const lenses::Surface& surface, const glm::dvec2& at) {
  lenses::Lens lens;
  lens.back = surface;
  lenses::LensModel model;
  lenses::append_lens(model, &lens, lenses::Side::right, 0.0);
  return lenses::f64::surface_point(lenses::f64::Table{model.table}, model.lens.front().back, at);
}

TEST(HeightField, AgreesWithDeBoorsRecursion) {
  Random random(kSeed);
  for (int trial = 0; trial < 50; ++trial) {
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", trial " << trial);
    const auto spline =
        support::height_field(support::uneven_knots(random, -0.02, 0.03, 2 + random.pick(8)),
                              trial % 2 == 0 ? support::even_knots(-0.025, 0.02, 3 + random.pick(6), false)
                                             : support::uneven_knots(random, -0.025, 0.02, 2 + random.pick(8)),
                              [&](double, double) { return random.uniform(-1e-3, 1e-3); });
    for (int i = 0; i < 50; ++i) {
      const double x = i == 0 ? 0.03 : random.uniform(-0.02, 0.03);
      const double y = i == 1 ? 0.02 : random.uniform(-0.025, 0.02);
      const auto p = point_of(spline, {x, y});
      EXPECT_TRUE(p.inside);
      EXPECT_NEAR(p.z, support::height_at(spline, x, y), 1e-16);
    }
    for (const double knot : spline.knots_x) {
      EXPECT_NEAR(point_of(spline, {knot, 0.001}).z, support::height_at(spline, knot, 0.001), 1e-16);
    }
  }
}

TEST(HeightField, ReproducesCubicsWithTheirDerivatives) {
  const auto cubic = [](const std::vector<double>& t, std::size_t i) { return t[i + 1] * t[i + 2] * t[i + 3]; };
  const std::vector<double> knots_x{-3, -3, -3, -3, -1, 0, 0, 2, 3, 3, 3, 3};
  const std::vector<double> knots_y{-5, -4, -3.5, -3, -1, 0.5, 1, 4, 4, 5, 6};
  lenses::BsplineHeightField spline{knots_x, knots_y, {}};
  for (std::size_t i = 0; i < spline.count_x(); ++i) {
    for (std::size_t j = 0; j < spline.count_y(); ++j) {
      const double x3 = cubic(knots_x, i);
      const double y = support::greville(knots_y, j);
      const double y2 = support::square_control(knots_y, j);
      spline.control_z.push_back(0.5 * x3 * y - 2.0 * support::greville(knots_x, i) * y2 + 3.0);
    }
  }
  for (const double x : {-3.0, -1.0, -0.4, 0.0, 1.7, 3.0}) {
    for (const double y : {-3.0, -2.2, -1.0, 0.5, 0.9, 1.0, 3.9}) {
      const auto p = point_of(spline, {x, y});
      EXPECT_NEAR(p.z, 0.5 * x * x * x * y - 2.0 * x * y * y + 3.0, 1e-12);
      EXPECT_NEAR(p.gradient.x, 1.5 * x * x * y - 2.0 * y * y, 1e-12);
      EXPECT_NEAR(p.gradient.y, 0.5 * x * x * x - 4.0 * x * y, 1e-12);
      EXPECT_NEAR(p.hessian.x, 3.0 * x * y, 1e-11);
      EXPECT_NEAR(p.hessian.y, 1.5 * x * x - 4.0 * y, 1e-11);
      EXPECT_NEAR(p.hessian.z, -4.0 * x, 1e-11);
    }
  }
}

TEST(HeightField, EndsAtItsPatch) {
  const auto knots = support::even_knots(-0.02, 0.02, 4, true);
  const auto spline = support::paraboloid(knots, knots, 5.0);
  EXPECT_TRUE(point_of(spline, {0.02, -0.02}).inside);
  EXPECT_FALSE(point_of(spline, {0.0200001, 0.0}).inside);
  EXPECT_FALSE(point_of(spline, {0.0, -0.0200001}).inside);
}

TEST(ParametricPatch, ReadsAsTheHeightFieldOfItsShape) {
  Random random(kSeed);
  const auto knots = support::even_knots(-0.03, 0.03, 6, true);
  const std::vector<double> uneven{-0.03, -0.03, -0.03, -0.03, -0.02, 0.001, 0.001, 0.02, 0.03, 0.03, 0.03, 0.03};
  const auto patch = support::parametric_paraboloid(knots, uneven, 12.0);
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", point " << i);
    const glm::dvec2 at(random.uniform(-0.02, 0.02), random.uniform(-0.02, 0.02));
    const auto p = point_of(patch, at);
    ASSERT_TRUE(p.inside);
    EXPECT_NEAR(p.z, 6.0 * glm::dot(at, at), 1e-16);
    EXPECT_NEAR(p.gradient.x, 12.0 * at.x, 1e-13);
    EXPECT_NEAR(p.gradient.y, 12.0 * at.y, 1e-13);
    EXPECT_NEAR(p.hessian.x, 12.0, 1e-9);
    EXPECT_NEAR(p.hessian.y, 0.0, 1e-9);
    EXPECT_NEAR(p.hessian.z, 12.0, 1e-9);
  }
}

TEST(ParametricPatch, MustNotFold) {
  const auto knots = support::even_knots(-0.03, 0.03, 6, true);
  auto patch = support::parametric_paraboloid(knots, knots, 12.0);
  std::swap(patch.control[patch.count_v() * 4 + 4], patch.control[patch.count_v() * 6 + 4]);
  lenses::Lens lens;
  lens.back = patch;
  lenses::LensModel model;
  EXPECT_THROW(lenses::append_lens(model, &lens, lenses::Side::right, 0.0), std::invalid_argument);
}

}  // namespace
