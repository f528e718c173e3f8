// The cases that broke programs of this kind, on both engines: here the surfaces, in hard_rays_test.cpp the rays. What
// each is held to is a closed form, Coddington's equations, a conic of the same shape, or the same lens written
// differently.
//
// Traced cases of tests/data hold others (the name is the case's id):
//   plano surfaces hard_plate_*, hard_plano_front_minus6     torus r -> R, tyre, barrel hard_torus_*
//   knot lines, double knots hard_bs_knot_*, hard_bs_c1_*    contact lens hard_contact_*, sem_contact_turning_*
//   inverted hard_inverted_edge                              total reflection hard_tir_*, hard_just_tir_*
//   misses and rims hard_miss_*, sem_miss_rim_*              umbilics, 45 degrees hard_axis_umbilic_*, hard_cos2theta_*
//   foci hard_focus_*                                        object at the focus hard_object_at_focus
//   n 1.9 hard_n19_oblique40                                 aplanatic points hard_aplanatic_*
// Sag files rounded to 1e-4 mm are in sampled_spline_test, more of contact lenses in contact_lens_test. Rays that run
// along an axis, and rays that start on a triangle, belong to the scene's traversal: bvh_test. Poses that are NaN or
// not normalised never reach a lens: stereo_view_test, bad_input_test.
#include "tests/support/de_boor.hpp"
#include "tests/support/hard_case.hpp"

namespace {

using lenses::RayStatus;
using lenses::Torus;
using lenses::TraceRequest;
using support::even_knots;
using support::HardCase;
using support::kRadians;

TEST_P(HardCase, PlanoSurfacesAndRadiiOfAThousandKilometres) {
  for (const double up : {0.0, 10.0, 40.0}) {
    const auto flat = trace(toward(through(lenses::Plane{}, lenses::Plane{}), 5.0, up));
    expect_vergence(flat, glm::dvec3(0.0));
    EXPECT_LE(flat.deviation, is_reference() ? 1e-15 : 1e-6);
    for (const double c : {1e-6, -1e-6}) {
      const auto almost = trace(toward(through(lenses::Sphere{c}, lenses::Torus{c, -c}), 5.0, up));
      ASSERT_EQ(almost.status, RayStatus::ok);
      EXPECT_LE(glm::length(almost.vergence), is_reference() ? 1e-5 : 1e-3);
      EXPECT_LE(glm::length(almost.front_hit - flat.front_hit), is_reference() ? 1e-8 : 1e-7);
    }
  }
}

TEST_P(HardCase, CylindersHaveOneFlatMeridian) {
  for (const auto revolve : {Torus::Revolve::u, Torus::Revolve::v}) {
    const auto request = through(Torus{0.0, 8.0, 0.0, revolve}, lenses::Plane{});
    expect_vergence(trace(request), {0.0, 0.0, axial_vergence(request, 8.0, 0.0)});
  }
  // Revolved or drawn out, it is one cylinder.
  expect_same(trace(toward(through(Torus{0.0, 8.0, 0.5, Torus::Revolve::u}, lenses::Sphere{5.0}), 25.0, -20.0)),
              trace(toward(through(Torus{0.0, 8.0, 0.5, Torus::Revolve::v}, lenses::Sphere{5.0}), 25.0, -20.0)));
}

TEST_P(HardCase, TorusOfEqualRadiiIsASphere) {
  std::vector<std::pair<TraceRequest, TraceRequest>> pairs;
  for (const double c : {-12.0, 12.0, 25.0}) {
    for (const double apart : {0.0, 1e-15, -1e-13, 1e-11}) {
      for (const auto revolve : {Torus::Revolve::u, Torus::Revolve::v}) {
        const Torus torus{c, c * (1.0 + apart), 0.7, revolve};
        pairs.emplace_back(toward(through(torus, lenses::Sphere{2.0}), 15.0, 10.0),
                           toward(through(lenses::Sphere{c}, lenses::Sphere{2.0}), 15.0, 10.0));
      }
    }
  }
  expect_same(pairs);
}

// The paper's r -> R: the circle's centre comes to lie on the axis of revolution's far rim.
TEST_P(HardCase, TorusPassesSmoothlyFromRingToSpindle) {
  const auto at = [](double ratio) {
    return trace(toward(through(Torus{12.0 * ratio, 12.0, 0.3}, lenses::Sphere{3.0}), 15.0, -12.0));
  };
  const auto horn = at(0.5);
  ASSERT_EQ(horn.status, RayStatus::ok);
  // 1e-6 of the curvature moves V by about 1e-5 D.
  for (const double ratio : {0.5 - 1e-6, 0.5 + 1e-6}) {
    const auto near = at(ratio);
    ASSERT_EQ(near.status, RayStatus::ok);
    EXPECT_LE(glm::length(near.vergence - horn.vergence), is_reference() ? 2e-5 : 1e-3);
  }
}

TEST_P(HardCase, NegativeRevolveRadiusIsASaddle) {
  for (const auto revolve : {Torus::Revolve::u, Torus::Revolve::v}) {
    const auto request = through(Torus{-9.0, 7.0, 0.0, revolve}, lenses::Plane{});
    expect_vergence(trace(request), {axial_vergence(request, -9.0, 0.0), 0.0, axial_vergence(request, 7.0, 0.0)});
  }
}

TEST_P(HardCase, TorusHasNoFarSide) {
  // Revolved at 20 mm, profile 40 mm: beyond u = 20 mm there is nothing but the ring's far side.
  const Torus ring{50.0, 25.0, 0.0, Torus::Revolve::u};
  EXPECT_EQ(trace(parallel(through(lenses::Plane{}, ring, 25.0), 20.5, 0.0)).status, RayStatus::miss_back);
  const auto hit = trace(parallel(through(lenses::Plane{}, ring, 25.0), 12.0, 9.0));
  ASSERT_EQ(hit.status, RayStatus::ok);
  const double profile = (1.0 - std::sqrt(1.0 - 25.0 * 25.0 * 0.009 * 0.009)) / 25.0;
  const double sag = 0.02 - std::sqrt((0.02 - profile) * (0.02 - profile) - 0.012 * 0.012);
  EXPECT_NEAR(hit.back_hit.z, sag - 0.01605, metres());
  // The sphere's far half is as little there.
  EXPECT_EQ(trace(parallel(through(lenses::Plane{}, lenses::Sphere{50.0}, 25.0), 20.5, 0.0)).status,
            RayStatus::miss_back);
}

TEST_P(HardCase, HighIncidenceTakesTheNearRoot) {
  for (const double up : {30.0, 50.0, 65.0}) {
    for (const double c : {-15.0, -4.0, 4.0, 15.0, 40.0}) {
      const auto result = trace(toward(through(lenses::Sphere{c}, lenses::Sphere{c}, 1.0), 0.0, up));
      if (result.status == RayStatus::miss_back) {
        continue;
      }
      // The first crossing of the ray and the vertex's half, by long division along the ray.
      const glm::dvec3 d = tracking::direction_from_yaw_pitch(0.0, up * kRadians);
      const double b = c * 0.01605 * d.z - d.z;
      const double k = (c * 0.01605 - 2.0) * 0.01605;
      const double t = -k / (b + std::sqrt(b * b - c * k));
      if (result.status == RayStatus::ok) {
        EXPECT_LE(glm::length(result.back_hit - t * d), metres()) << up << " " << c;
      }
      EXPECT_LE(c * (t * d.z + 0.01605), 1.0) << up << " " << c;
    }
  }
}

// A spline that equals a paraboloid against the conic of the same shape.
TEST_P(HardCase, SplinesMatchTheConicAtEveryIncidence) {
  const auto knots = even_knots(-0.06, 0.06, 9, true);
  for (const double c : {-8.0, 6.0, 14.0}) {
    std::vector<TraceRequest> conic, heights, patch;
    for (const double right : {-60.0, -35.0, -11.0, 0.0, 7.0, 25.0, 50.0, 60.0}) {
      for (const double up : {-50.0, -10.0, 0.0, 12.0, 45.0}) {
        conic.push_back(toward(through(lenses::Sphere{2.0}, lenses::Conic{c, -1.0, {}}), right, up));
        heights.push_back(conic.back());
        heights.back().lens->back = support::paraboloid(knots, knots, c);
        patch.push_back(conic.back());
        patch.back().lens->back = support::parametric_paraboloid(knots, knots, c);
      }
    }
    const auto expected = trace(conic);
    const auto by_heights = trace(heights);
    const auto by_patch = trace(patch);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      SCOPED_TRACE(testing::Message() << "curvature " << c << ", ray " << i);
      expect_same(by_heights[i], expected[i]);
      expect_same(by_patch[i], expected[i]);
    }
  }
}

// Waves steep enough that Newton's steps from the base sphere jump to and fro: the hit is on the spline, and no
// crossing comes before it.
TEST_P(HardCase, SplineHitsAreTheFirstCrossing) {
  const auto knots = even_knots(-0.05, 0.05, 24, false);
  const auto wave = support::height_field(knots, knots, [](double x, double y) {
    return 1.2e-3 * std::sin(420.0 * x) * std::cos(300.0 * y) + 3.0 * (x * x + y * y);
  });
  int hits = 0;
  for (const double up : {5.0, 20.0, 40.0, 50.0, 60.0, 64.0}) {
    for (const double right : {-17.0, 0.0, 9.0, 30.0}) {
      auto request = toward(through(lenses::Plane{}, wave, 20.0), right, up);
      const auto result = trace(request);
      if (result.status != RayStatus::ok) {
        continue;
      }
      ++hits;
      const double t = glm::length(result.back_hit);
      const glm::dvec3 d = glm::normalize(request.direction);
      const auto above = [&](double along) {
        return along * d.z + 0.01605 - support::height_at(wave, along * d.x, along * d.y);
      };
      EXPECT_NEAR(above(t), 0.0, is_reference() ? 1e-12 : 2e-7) << up << " " << right;
      for (int i = 0; i < 2000; ++i) {
        ASSERT_GT(above((t - 1e-5) * i / 2000.0), 0.0) << up << " " << right << ": an earlier crossing";
      }
    }
  }
  EXPECT_GE(hits, 10);
}

TEST_P(HardCase, StartOutsideThePatch) {
  // The pupil stands 30 mm beside a patch of +-20 mm.
  const auto knots = even_knots(-0.02, 0.02, 5, true);
  for (const double right : {-70.0, -62.0, -50.0}) {
    auto conic = toward(parallel(through(lenses::Plane{}, lenses::Conic{5.0, -1.0, {}}, 8.0), 30.0, 0.0), right, 3.0);
    conic.lens->diameter = 0.035;  // within the patch
    auto spline = conic;
    spline.lens->back = support::paraboloid(knots, knots, 5.0);
    auto patch = conic;
    patch.lens->back = support::parametric_paraboloid(knots, knots, 5.0);
    const auto expected = trace(conic);
    expect_same(trace(spline), expected);
    expect_same(trace(patch), expected);
  }
}

// Far beside a small lens, at grazing incidence: Newton's method hands over to the search along the ray.
TEST_P(HardCase, StartFarBesideASmallLens) {
  const auto knots = even_knots(-0.02, 0.02, 5, true);
  for (const double beside_mm : {30.0, 60.0, 95.0}) {
    const double right = -std::atan(beside_mm / 16.05) / kRadians;
    auto sphere = toward(parallel(through(lenses::Plane{}, lenses::Sphere{0.5}, 1.0), beside_mm, 0.0), right, 0.0);
    sphere.lens->diameter = 0.016;
    const auto expected = trace(sphere);
    ASSERT_EQ(expected.status, RayStatus::ok);
    auto torus = sphere;
    torus.lens->back = Torus{0.5, 0.5};
    expect_same(trace(torus), expected);
    auto conic = sphere;
    conic.lens->back = lenses::Conic{0.5, -1.0, {}};
    const auto as_conic = trace(conic);
    auto spline = sphere;
    spline.lens->back = support::paraboloid(knots, knots, 0.5);
    EXPECT_EQ(as_conic.status, RayStatus::ok);
    expect_same(trace(spline), as_conic);
  }
}

TEST_P(HardCase, HitsOnKnotLinesAndRepeatedKnots) {
  const std::vector<double> doubled{-0.05, -0.05, -0.05, -0.05, -0.01, -0.01, 0.0,
                                    0.0,   0.0,   0.012, 0.05,  0.05,  0.05,  0.05};
  const auto plain = even_knots(-0.05, 0.05, 10, false);
  std::vector<std::pair<TraceRequest, TraceRequest>> pairs;
  for (const auto& [x, y] : std::vector<std::pair<double, double>>{
           {0.0, 0.0}, {0.0, 7.0}, {-10.0, 0.0}, {-10.0, 10.0}, {12.0, -10.0}, {10.0, 3.3}, {20.0, 20.0}}) {
    const auto conic = parallel(through(lenses::Sphere{3.0}, lenses::Conic{9.0, -1.0, {}}, 4.0), x, y);
    for (const auto* knots : {&doubled, &plain}) {
      auto heights = conic;
      heights.lens->back = support::paraboloid(*knots, plain, 9.0);
      auto patch = conic;
      patch.lens->back = support::parametric_paraboloid(plain, *knots, 9.0);
      pairs.emplace_back(heights, conic);
      pairs.emplace_back(patch, conic);
    }
  }
  expect_same(pairs);
}

TEST_P(HardCase, PatchBorders) {
  const auto knots = even_knots(-0.02, 0.02, 4, true);
  const auto patch = support::paraboloid(knots, knots, 4.0);
  const auto at = [&](double x_mm, double y_mm) {
    return trace(parallel(through(lenses::Plane{}, patch, 4.0), x_mm, y_mm)).status;
  };
  for (const double y : {0.0, 20.0 - 1e-3, 10.0}) {
    EXPECT_EQ(at(20.0 - 1e-3, y), RayStatus::ok);
    EXPECT_EQ(at(20.0 + 1e-3, y), RayStatus::miss_back);
    const auto border = at(20.0, y);
    EXPECT_TRUE(border == RayStatus::ok || border == RayStatus::miss_back);
  }
}

TEST_P(HardCase, PlusAndMinusCylinderForms) {
  for (const double axis : {0.0, 0.4, 1.6, 3.1}) {
    const Torus plus{9.0, 5.0, axis, Torus::Revolve::u};
    const Torus minus{5.0, 9.0, axis + 0.5 * std::numbers::pi, Torus::Revolve::v};
    expect_same(trace(toward(through(plus, lenses::Sphere{3.0}), 20.0, -15.0)),
                trace(toward(through(minus, lenses::Sphere{3.0}), 20.0, -15.0)));
  }
}

INSTANTIATE_TEST_SUITE_P(Engines, HardCase, testing::Values(support::Engine::reference, support::Engine::gpu),
                         support::engine_name);

}  // namespace
