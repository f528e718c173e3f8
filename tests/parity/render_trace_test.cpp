// Every pixel of the renderer's wavefront against the double-precision trace of that pixel's ray and Embree's hit of
// the refracted ray: fixed, gaze and scanning viewing, both eyes, lopsided fields of view, every kind of lens.
#include <gtest/gtest.h>

#include <algorithm>

#include "render/scene/ray_query.hpp"
#include "render/vk/device.hpp"
#include "tests/support/contact_lens.hpp"
#include "tests/support/random_lens.hpp"
#include "tests/support/worn_views.hpp"

namespace {

using lenses::Lens;
using render::RenderedView;
using render::ViewSetup;
using support::WornPair;

constexpr int kWidth = 97, kHeight = 81;  // odd: the centre pixel lies on the picture's axis; no multiple of a tile
// A float engine's V is good to 1e-3 D (random_rays_test); the pixel's direction, rounded to float, and the steep power
// near a rim are allowed as much again.
constexpr double kDioptres = 2e-3;
constexpr double kDepth = 1e-4;  // relative

const tracking::FieldOfView kLopsided{.tan_left = 0.75, .tan_right = 0.45, .tan_down = 0.85, .tan_up = 0.4};

// Not along any axis, and off the scene's own camera.
tracking::Pose head_in_room(const render::Scene& scene) {
  tracking::Pose pose = scene.start_pose().value();
  pose.position += glm::dvec3(0.05, 0.03, -0.02);
  pose.orientation = pose.orientation * tracking::orientation_from_yaw_pitch(0.07, -0.05);
  return pose;
}

Lens tilted_sphere() {
  Lens lens;
  lens.index = 1.6;
  lens.diameter = 0.040;  // small: rim and bare scene are in the picture
  lens.front = lenses::Sphere{5.0};
  lens.back = lenses::Sphere{12.0};
  lens.fit.pantoscopic_tilt = 9.0 * support::kDegree;
  lens.fit.wrap = 6.0 * support::kDegree;
  lens.fit.decentration = {0.001, -0.002};
  return lens;
}

Lens torus_lens(lenses::Torus::Revolve revolve) {
  Lens lens;
  lens.index = 1.6;
  lens.centre_thickness = 0.005;
  lens.diameter = 0.050;
  lens.front = lenses::Torus{11.0, 8.0, 35.0 * support::kDegree, revolve};
  lens.back = lenses::Torus{5.0, 7.5, 100.0 * support::kDegree, lenses::Torus::Revolve::u};
  lens.fit.pantoscopic_tilt = 8.0 * support::kDegree;
  return lens;
}

Lens conic_lens() {
  Lens lens;
  lens.index = 1.67;
  lens.centre_thickness = 0.006;
  lens.front = lenses::Conic{12.0, -1.2, {3.0, 500.0}};
  lens.back = lenses::Plane{};
  return lens;
}

struct LensCase {
  std::string name;
  std::optional<lenses::Spectacles> spectacles;
};

LensCase same_for_both(const std::string& name, const Lens& lens) {
  return {name, lenses::Spectacles{name, {lens, lens}, glm::dvec3(1.0)}};
}

std::vector<LensCase> lens_cases() {
  support::Random random(11);
  return {
      {"bare", std::nullopt},
      same_for_both("sphere", tilted_sphere()),
      same_for_both("torus revolved about v", torus_lens(lenses::Torus::Revolve::u)),
      same_for_both("torus revolved about u", torus_lens(lenses::Torus::Revolve::v)),
      same_for_both("conic and plane", conic_lens()),
      same_for_both("contact lens", support::contact_lens()),
      same_for_both("parametric B-spline", support::ordinary_lens(random, 5, 1)),
      {"bifocal", lenses::read_spectacles(VERGENCE_ASSETS "/spectacles/presbyopia_bifocal.json")},
      {"prism", lenses::read_spectacles(VERGENCE_ASSETS "/spectacles/prism.json")},
      {"progressive with sphere",
       lenses::read_spectacles(VERGENCE_ASSETS "/spectacles/presbyopia_bspline_sphere.json")},
      {"progressive with torus", lenses::read_spectacles(VERGENCE_ASSETS "/spectacles/presbyopia_bspline_torus.json")}};
}

// Astigmatic, ametropic, and not alike, so that no term of the residual drops out.
lenses::Wearer odd_wearer() {
  lenses::Wearer wearer;
  wearer.age = 47.0;
  wearer.pupillary_distance = {0.0325, 0.0305};
  wearer.eye[0].power = lenses::Refraction{-1.25, -0.75, 0.3};
  wearer.eye[0].accommodation_amplitude = 1.2;
  wearer.eye[1].power = lenses::Refraction{0.5, -1.5, 2.1};
  wearer.eye[1].accommodation_amplitude = 2.0;
  wearer.eye[1].pupil_diameter = 0.005;
  return wearer;
}

struct Tally {
  std::size_t pixels = 0, through = 0, rim = 0, beside = 0, sky = 0;
  std::size_t status_differs = 0, depth_differs = 0;
  double worst_vergence = 0.0;
};

bool is_rim(int status) {
  using namespace lenses::f64;  // NOLINT(google-build-using-namespace)
  return status != kStatusOk && status != kStatusMissBack;
}

struct Picture {
  const WornPair& pair;
  const ViewSetup& setup;
  const RenderedView& view;
};

void expect_pixel(const Picture& picture, int x, int y, const render::RayQuery& query, Tally& tally) {
  const auto& [pair, setup, view] = picture;
  const auto at = static_cast<std::size_t>(y) * kWidth + static_cast<std::size_t>(x);
  const glm::dvec3 v(view.wavefront.v_hh[at], view.wavefront.v_hv[at], view.wavefront.v_vv[at]);
  const double depth = view.wavefront.depth[at];
  auto reference = support::reference_pixel(pair, setup, support::pixel_direction(setup, x, y, kWidth, kHeight));
  ++tally.pixels;
  if (is_rim(reference.status) != (depth < 0.0)) {
    ++tally.status_differs;  // within rounding of the rim
    return;
  }
  if (is_rim(reference.status)) {
    ++tally.rim;
    EXPECT_EQ(depth, -1.0F);
    EXPECT_EQ(v, glm::dvec3(0.0));
    EXPECT_EQ(view.wavefront.blur[at], 0.0F);
    return;
  }
  const auto hit = query.closest(reference.start, reference.direction);
  if (hit.has_value() != (depth > 0.0) || (hit && std::abs(depth - hit->distance) > kDepth * hit->distance)) {
    ++tally.depth_differs;  // an edge between this ray and its rounded one
  }
  tally.sky += depth == 0.0 ? 1 : 0;
  const double q = depth > 0.0 ? 1.0 / depth : 0.0;
  reference.ray.direction.w = q;
  const bool bare = reference.status == lenses::f64::kStatusMissBack;
  (bare ? tally.beside : tally.through) += 1;
  const auto record = lenses::f64::trace_record(lenses::f64::Table{pair.model.table}, pair.model.lens[setup.lens],
                                                setup.eye, reference.ray);
  const glm::dvec3 expected = bare ? glm::dvec3(-q, 0.0, -q) : glm::dvec3(record.vergence);
  const glm::dvec3 error = glm::abs(v - expected);
  const double worst = std::max({error.x, error.y, error.z});
  tally.worst_vergence = std::max(tally.worst_vergence, worst);
  EXPECT_LE(worst, kDioptres) << "pixel " << x << ", " << y << ", depth " << depth << ", wanted " << expected.x << " "
                              << expected.y << " " << expected.z << ", got " << v.x << " " << v.y << " " << v.z;
  const double accommodation = setup.accommodation.value_or(lenses::f64::clamped_accommodation(expected, setup.eye));
  EXPECT_NEAR(view.wavefront.accommodation[at], accommodation, kDioptres);
  // |eig| of a symmetric 2x2 changes by no more than twice its entries do; the accommodation's error is one more.
  const glm::dvec3 r = expected + glm::dvec3(setup.eye.excess.x, setup.eye.excess.y, setup.eye.excess.z) +
                       glm::dvec3(accommodation, 0.0, accommodation);
  const double mean = 0.5 * (r.x + r.z);
  const double radius = std::hypot(0.5 * (r.x - r.z), r.y);
  const double half_pupil = 0.5 * setup.eye.pupil.x;
  EXPECT_NEAR(view.wavefront.blur[at], half_pupil * (std::abs(mean) + radius), half_pupil * 3.0 * kDioptres);
}

class RenderedWavefront : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    device_ = new render::vk::Device();
    scene_ = new render::Scene(support::reading_room());
    query_ = new render::RayQuery(*scene_);
    renderer_ = new render::Renderer(*device_, *scene_);
  }
  static void TearDownTestSuite() {
    delete renderer_;
    delete query_;
    delete scene_;
    delete device_;
  }

  static render::RenderedFrame render(const WornPair& pair, const std::vector<ViewSetup>& views) {
    render::FrameConfig config;
    config.width = kWidth;
    config.height = kHeight;
    config.keep_wavefront = true;
    return renderer_->render(pair.model, views, config);
  }

  static Tally compare(const WornPair& pair, const std::vector<ViewSetup>& views) {
    const auto frame = render(pair, views);
    Tally tally;
    for (std::size_t i = 0; i < views.size(); ++i) {
      for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
          expect_pixel({pair, views[i], frame.views[i]}, x, y, *query_, tally);
        }
      }
    }
    EXPECT_LE(tally.status_differs, tally.pixels / 100);
    EXPECT_LE(tally.depth_differs, tally.pixels / 100);
    return tally;
  }

  static void expect_every_lens(render::Viewing viewing) {
    Tally all;
    for (const LensCase& c : lens_cases()) {
      SCOPED_TRACE(c.name);
      const auto pair = support::wear(odd_wearer(), c.spectacles ? &*c.spectacles : nullptr, head_in_room(*scene_));
      for (const char* target : {"near_card", "window"}) {
        SCOPED_TRACE(target);
        const Tally tally =
            compare(pair, support::views_at(pair, viewing, support::target_position(*scene_, target), kLopsided));
        EXPECT_GT(tally.through, tally.pixels / 20) << "hardly any pixel tests the lens";
        std::cout << c.name << ", " << target << ": " << tally.through << " through, " << tally.beside << " beside, "
                  << tally.rim << " rim, " << tally.sky << " sky; V to " << tally.worst_vergence << " D, depth differs "
                  << tally.depth_differs << ", status " << tally.status_differs << " of " << tally.pixels << "\n";
        all.rim += tally.rim;
        all.beside += tally.beside;
        all.sky += tally.sky;
      }
    }
    // All of these must have been met, or the test is blind to them.
    EXPECT_GT(all.rim, 100U);
    EXPECT_GT(all.beside, 100U);
    EXPECT_GT(all.sky, 100U);
  }

  inline static render::vk::Device* device_ = nullptr;
  inline static render::Scene* scene_ = nullptr;
  inline static render::RayQuery* query_ = nullptr;
  inline static render::Renderer* renderer_ = nullptr;
};

TEST_F(RenderedWavefront, IsTheReferenceTraceInFixedViewing) {
  expect_every_lens(render::Viewing::fixed);
}

TEST_F(RenderedWavefront, IsTheReferenceTraceInGazeViewing) {
  expect_every_lens(render::Viewing::gaze);
}

TEST_F(RenderedWavefront, IsTheReferenceTraceInScanningViewing) {
  expect_every_lens(render::Viewing::scanning);
}

// Pixels as points of a headset's virtual image, the view's origin in the pupil or in the centre of rotation.
TEST_F(RenderedWavefront, IsTheReferenceTraceInAHeadset) {
  const auto spectacles = lenses::read_spectacles(VERGENCE_ASSETS "/spectacles/presbyopia_bspline_torus.json");
  const auto pair = support::wear(odd_wearer(), &spectacles, head_in_room(*scene_));
  for (const render::Viewing viewing : {render::Viewing::fixed, render::Viewing::gaze}) {
    for (const double behind : {0.0, pair.eyes[0].eye.pupil.y}) {
      auto views = support::views_at(pair, viewing, support::target_position(*scene_, "phone"), kLopsided);
      for (ViewSetup& view : views) {
        view.virtual_image = render::VirtualImage{1.3, behind};
      }
      compare(pair, views);
    }
  }
}

// One state for the whole picture: the lesser of the two eyes' demands at the fixated point, each eye limited by its
// own amplitude. The picture's centre pixel looks at that point.
TEST_F(RenderedWavefront, AccommodationInGazeViewingIsTheLesserDemand) {
  const auto spectacles = lenses::read_spectacles(VERGENCE_ASSETS "/spectacles/myopia.json");
  lenses::Wearer wearer = odd_wearer();
  wearer.eye[0].power = lenses::Refraction{-5.5, 0.0, 0.0};  // half a dioptre over-corrected: asks for more
  wearer.eye[1].power = lenses::Refraction{-6.0, 0.0, 0.0};
  const auto symmetric = tracking::FieldOfView::symmetric(30.0 * support::kDegree, double{kWidth} / kHeight);
  for (const double right_amplitude : {8.0, 1.0}) {
    wearer.eye[0].accommodation_amplitude = right_amplitude;
    wearer.eye[1].accommodation_amplitude = 8.0;
    const auto pair = support::wear(wearer, &spectacles, head_in_room(*scene_));
    const auto views =
        support::views_at(pair, render::Viewing::gaze, support::target_position(*scene_, "screen"), symmetric);
    const auto frame = render(pair, views);
    std::array<double, 2> demand{};
    const std::size_t centre = static_cast<std::size_t>(kHeight / 2) * kWidth + kWidth / 2;
    for (const std::size_t i : {0U, 1U}) {
      const auto& w = frame.views[i].wavefront;
      demand[i] = -0.5 * (w.v_hh[centre] + w.v_vv[centre] + pair.eyes[i].eye.excess.x + pair.eyes[i].eye.excess.z);
    }
    EXPECT_GT(demand[0], demand[1] + 0.3);
    const double drive = std::min(demand[0], demand[1]);
    for (const std::size_t i : {0U, 1U}) {
      const double expected = std::min(drive, pair.eyes[i].eye.excess.w);
      for (const float state : frame.views[i].wavefront.accommodation) {
        // What stands 1 mm in front of the sheet at 0.7 m is worth 2e-3 D.
        if (state != 0.0F) {
          ASSERT_NEAR(state, expected, 4e-3);
        }
        ASSERT_TRUE(state == 0.0F || state == frame.views[i].wavefront.accommodation[centre]);
      }
    }
  }
}

}  // namespace
