// The samples of distributed rays that the device traces, against the double-precision tracer: through the pupil's rim
// as well as through its middle, behind every kind of lens, from every way of viewing. And both eyes take the same.
#include <gtest/gtest.h>

#include "render/frame_buffers.hpp"
#include "render/frame_job.hpp"
#include "render/sample_point.hpp"
#include "render/shaders/sample_pattern.h"
#include "render/vk/device.hpp"
#include "tests/support/lit_scene.hpp"
#include "tests/support/random_lens.hpp"

namespace {

namespace gpu = render::gpu;
using lenses::Lens;
using render::ViewSetup;
using support::f64::SightLine;

constexpr int kSize = 48;
constexpr std::uint32_t kSeed = 5;

Lens first_of(const std::string& file) {
  return lenses::read_spectacles(std::string(VERGENCE_ASSETS "/spectacles/") + file + ".json").lens[0];
}

Lens wrapped_torus() {
  Lens lens;
  lens.index = 1.6;
  lens.centre_thickness = 0.004;
  lens.diameter = 0.06;
  lens.front = lenses::Torus{11.0, 8.0, 0.6};
  lens.back = lenses::Sphere{14.0};
  lens.fit.wrap = 20.0 * support::kDegree;
  lens.fit.pantoscopic_tilt = 10.0 * support::kDegree;
  lens.fit.decentration = {0.003, -0.004};
  return lens;
}

// A few lenses at a time: kernels are compiled for the kinds of surfaces in a frame.
std::vector<std::vector<Lens>> lens_groups() {
  support::Random random(11);
  return {
      {first_of("presbyopia_bspline_sphere"), wrapped_torus(), first_of("myopia"), first_of("myopia_contact_lenses")},
      {first_of("presbyopia_bspline_torus"), first_of("presbyopia_bifocal"), first_of("prism"),
       support::ordinary_lens(random, 5, 2)}};
}

// One view a lens, of an astigmatic eye with a wide pupil that looks down and aside.
struct Scene {
  lenses::LensModel model;
  std::vector<ViewSetup> views;
};

Scene behind(const std::vector<Lens>& lens_list, render::Viewing viewing) {
  Scene scene;
  for (const Lens& lens : lens_list) {
    lenses::Eye eye;
    eye.power = lenses::Refraction{-2.0, -1.5, 0.4};
    support::WornPair pair;
    pair.lens[0] = lenses::append_lens(scene.model, &lens, lenses::Side::right, eye.entrance_pupil_depth);
    pair.eyes[0].eye = lenses::make_eye_data(eye, 3.0, 0.006);
    pair.eyes[0].world_from_eye.position = {0.3, 1.2, -0.4};
    const double half = 0.2;
    const bool contact = lens.attached_to == Lens::AttachedTo::eye && viewing != render::Viewing::gaze;
    // A lens that turns with the eye alone is small: what does not turn looks straight on.
    const auto gaze = contact ? glm::dvec3(0.0, 0.0, -1.0) : tracking::direction_from_yaw_pitch(0.1, -0.25);
    scene.views.push_back(support::view_along(pair, 0, viewing, gaze, {half, half, half, half}));
    if (viewing != render::Viewing::scanning) {
      scene.views.back().accommodation = 1.25;
    }
  }
  return scene;
}

// What the device left of every sample's rays.
struct DeviceRays {
  std::vector<glm::vec4> origins, directions, wavefronts;
};

class PupilRim : public testing::Test {
 protected:
  DeviceRays traced(const Scene& scene, std::uint32_t sample, bool in_double = false) {
    render::FrameConfig config;
    config.width = config.height = kSize;
    config.mode = render::Mode::dof;
    config.seed = kSeed;
    config.bare = true;
    config.accuracy.lens.in_double = in_double;
    const std::size_t pixels = scene.views.size() * kSize * kSize;
    const bool own_focus = render::keeps_wavefront(config, scene.views);
    render::FrameBuffers out(device_, render::buffers_for(config, scene.views, render::Traversal::tile));
    render::FrameJob job(device_, buffers_, kernels_, out, scene.model, scene.views, config, render::Traversal::tile);
    render::vk::Commands commands(device_);
    if (own_focus) job.record_trace(commands);
    job.record_sample(commands, static_cast<int>(sample));
    device_.run(commands);
    return {out.ray_origins.read<glm::vec4>(pixels), out.ray_directions.read<glm::vec4>(pixels),
            own_focus ? out.wavefronts.read<glm::vec4>(2 * pixels) : std::vector<glm::vec4>{}};
  }

  static render::Scene wall() {
    render::Scene scene = support::dark_scene();
    support::add_wall(scene, support::add_material(scene, support::unlit(glm::vec4(1.0F))), 0.0F, 0.0F, 3.0F, 10.0F);
    return scene;
  }

  render::vk::Device device_;
  render::SceneBuffers buffers_{device_, wall()};
  render::KernelSet kernels_{device_};
};

// A pixel's sample as the definitions have it: paper section 6.2, with p = -(E - I/l) s.
struct ReferenceSample {
  double radius;  // of the pupil's
  SightLine line;
};

ReferenceSample reference(const Scene& scene, std::size_t view_index, std::uint32_t sample, int x, int y,
                          double accommodation) {
  const ViewSetup& view = scene.views[view_index];
  const glm::dvec4 u(gpu::sample_pattern(render::sample_point(sample, kSeed), sample,
                                         {static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)}, kSeed));
  const glm::dvec2 disc(gpu::to_disc({static_cast<float>(u.x), static_cast<float>(u.y)}));
  const glm::dvec2 s = 0.5 * view.eye.pupil.x * disc;
  const glm::dvec4& e = view.eye.excess;
  const glm::dmat2 excess(e.x + accommodation, e.y, e.y, e.z + accommodation);
  const tracking::FieldOfView& fov = view.view.fov;
  const glm::dvec3 in_picture(-fov.tan_left + (fov.tan_left + fov.tan_right) * (x + u.z) / kSize,
                              fov.tan_up - (fov.tan_up + fov.tan_down) * (y + u.w) / kSize, -1.0);
  const glm::dvec3 direction = glm::normalize(view.view.head_from_view.orientation * in_picture);
  const auto turn = support::f64::eye_turn(static_cast<int>(view.viewing), view.view.gaze, direction);
  return {glm::length(disc),
          support::f64::trace_sight_line(support::f64::Table{scene.model.table}, scene.model.lens[view.lens], view.eye,
                                         turn, direction, s, -(excess * s))};
}

// How far the device's rays of one view are from the reference.
struct Deviation {
  int through = 0, at_rim = 0, differ = 0;  // rays; differ: in whether they pass the lens
  double angle = 0.0, place = 0.0;          // the largest, rad, m
};

Deviation deviation(const Scene& scene, std::size_t view_index, std::uint32_t sample, const DeviceRays& rays) {
  const ViewSetup& view = scene.views[view_index];
  Deviation d;
  for (int i = 0; i < kSize * kSize; ++i) {
    const std::size_t at = view_index * kSize * kSize + static_cast<std::size_t>(i);
    const double accommodation = view.accommodation ? *view.accommodation : rays.wavefronts[2 * at].w;
    const auto expected = reference(scene, view_index, sample, i % kSize, i / kSize, accommodation);
    const bool passes = expected.line.status == support::f64::kStatusOk;
    if (passes != (rays.directions[at].w > 0.0F)) {
      ++d.differ;
      continue;
    }
    if (!passes) continue;
    ++d.through;
    d.at_rim += expected.radius > 0.95 ? 1 : 0;
    const tracking::Pose& world = view.world_from_eye;
    const glm::dvec3 direction = world.direction(expected.line.direction_object);
    d.angle = std::max(d.angle, glm::length(glm::cross(direction, glm::normalize(glm::dvec3(rays.directions[at])))));
    d.place = std::max(d.place, glm::length(world.point(expected.line.start) - glm::dvec3(rays.origins[at])));
  }
  return d;
}

TEST_F(PupilRim, RaysAreThoseOfTheReference) {
  for (const auto viewing : {render::Viewing::gaze, render::Viewing::scanning}) {
    for (const std::vector<Lens>& group : lens_groups()) {
      const Scene scene = behind(group, viewing);
      int at_rim = 0;
      for (const std::uint32_t sample : {0U, 7U, 1001U}) {
        const DeviceRays rays = traced(scene, sample);
        for (std::size_t v = 0; v < scene.views.size(); ++v) {
          SCOPED_TRACE(testing::Message()
                       << "lens " << v << ", viewing " << static_cast<int>(viewing) << ", sample " << sample);
          const Deviation d = deviation(scene, v, sample, rays);
          EXPECT_LE(d.angle, 1e-5);
          EXPECT_LE(d.place, 1e-6);  // m; the world's coordinates are metres in single precision
          EXPECT_GE(d.through, kSize * kSize / 2);
          EXPECT_LE(d.differ, kSize * kSize / 500);  // within rounding of a rim or a segment's edge
          at_rim += d.at_rim;
        }
      }
      EXPECT_GE(at_rim, 1000);
    }
  }
}

// What is left is how the ray is stored: a unit vector in single precision, a place 1.2 m from the origin.
TEST_F(PupilRim, InDoublePrecisionRaysAreTheReferenceToAFloat) {
  if (!device_.limits().has_float64) {
    GTEST_SKIP() << device_.name() << " has no double precision";
  }
  const Scene scene = behind(lens_groups().front(), render::Viewing::gaze);
  const DeviceRays rays = traced(scene, 7, true);
  for (std::size_t v = 0; v < scene.views.size(); ++v) {
    const Deviation d = deviation(scene, v, 7, rays);
    EXPECT_LE(d.angle, 1e-7) << v;
    EXPECT_LE(d.place, 1.5e-7) << v;
  }
}

// Two bare eyes far apart, their heads turned: seen in its own axes each ray starts from the same point of the pupil
// and leaves in the same direction. A float of metres has 1e-7 m.
TEST_F(PupilRim, BothEyesTakeTheSameSamples) {
  Scene scene;
  for (const double side : {1.0, -1.0}) {
    support::WornPair pair;
    pair.lens[0] = lenses::append_lens(scene.model, nullptr, lenses::Side::right, 0.003);
    pair.eyes[0].eye = lenses::make_eye_data(lenses::Eye{}, 0.0, 0.006);
    pair.eyes[0].world_from_eye =
        tracking::Pose{tracking::orientation_from_yaw_pitch(0.4 * side, 0.1), {side, 0.5, 0.2}};
    scene.views.push_back(support::view_along(pair, 0, render::Viewing::fixed, {0, 0, -1}, {0.3, 0.3, 0.3, 0.3}));
    scene.views.back().accommodation = 0.0;
  }
  const DeviceRays rays = traced(scene, 12);
  double widest = 0.0;
  for (std::size_t i = 0; i < std::size_t{kSize} * kSize; ++i) {
    const auto in_eye = [&](std::size_t v) {
      const std::size_t at = v * kSize * kSize + i;
      const glm::dquat back = glm::conjugate(scene.views[v].world_from_eye.orientation);
      return std::pair(back * (glm::dvec3(rays.origins[at]) - scene.views[v].world_from_eye.position),
                       back * glm::dvec3(rays.directions[at]));
    };
    const auto [right_start, right_direction] = in_eye(0);
    const auto [left_start, left_direction] = in_eye(1);
    ASSERT_LE(glm::length(right_start - left_start), 3e-7);
    ASSERT_LE(glm::length(right_direction - left_direction), 1e-6);
    widest = std::max(widest, glm::length(right_start));
  }
  EXPECT_GT(widest, 0.0005);  // not all through the middle
}

}  // namespace
