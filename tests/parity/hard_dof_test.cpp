// Distributed rays through lenses and eyes that broke programs of this kind: every sample is light, never NaN, whatever
// the lens, the eye's residual or where the scene begins.
#include <gtest/gtest.h>

#include <cmath>

#include "render/vk/device.hpp"
#include "tests/support/absurd_lens.hpp"
#include "tests/support/lit_scene.hpp"

namespace {

using lenses::Lens;
using lenses::Torus;

Lens lens_of(const lenses::Surface& front, const lenses::Surface& back, double thickness_mm, double index = 1.5) {
  Lens lens;
  lens.index = index;
  lens.front = front;
  lens.back = back;
  lens.centre_thickness = 1e-3 * thickness_mm;
  lens.diameter = 0.06;
  return lens;
}

Lens contact_lens() {
  Lens lens = lens_of(lenses::Sphere{1.0 / 0.0089}, lenses::Sphere{1.0 / 0.0086}, 0.1, 1.43);
  lens.fit.vertex_distance = 0.0;
  lens.diameter = 0.0142;
  lens.attached_to = Lens::AttachedTo::eye;
  return lens;
}

Lens grazing(Lens lens) {
  lens.fit.wrap = 50.0 * support::kDegree;
  lens.fit.pantoscopic_tilt = -35.0 * support::kDegree;
  return lens;
}

// Few kinds of surfaces in a group: their kernels are compiled together.
struct Group {
  const char* name;
  std::vector<Lens> lenses;
};

std::vector<Group> groups() {
  const lenses::Plane plane;
  const auto doubled =
      std::vector<double>{-0.05, -0.05, -0.05, -0.05, -0.01, -0.01, 0.0, 0.0, 0.0, 0.012, 0.05, 0.05, 0.05, 0.05};
  const auto wave = support::height_field(doubled, support::even_knots(-0.05, 0.05, 10, false), [](double x, double y) {
    return 1.2e-3 * std::sin(420.0 * x) * std::cos(300.0 * y) + 3.0 * (x * x + y * y);
  });
  const auto small =
      support::height_field(support::even_knots(-0.02, 0.02, 5, true), support::even_knots(-0.02, 0.02, 5, true),
                            [](double x, double y) { return 2.0 * (x * x + y * y); });
  support::Random random(20120621);
  return {{"spheres",
           {lens_of(lenses::Sphere{25.0}, lenses::Sphere{-25.0}, 9.0),  // about +25 D
            lens_of(lenses::Sphere{-20.0}, lenses::Sphere{30.0}, 1.0),  // -25 D
            lens_of(lenses::Sphere{15.0}, lenses::Sphere{2.0}, 0.5),    // crossed: inverted beside the middle
            contact_lens()}},
          {"spheres of every index",
           {lens_of(lenses::Sphere{5.0}, lenses::Sphere{5.0}, 0.0),     // no thickness at all
            lens_of(lenses::Sphere{50.0}, lenses::Sphere{1e-6}, 10.0),  // total reflection; a radius of 1000 km
            grazing(lens_of(lenses::Sphere{8.0}, lenses::Sphere{12.0}, 3.0, 1.9)),
            lens_of(lenses::Sphere{12.0}, lenses::Sphere{20.0}, 2.0, 1.0)}},  // air
          {"tori",
           {lens_of(Torus{0.0, 8.0, 0.3, Torus::Revolve::u}, plane, 3.0),  // a cylinder
            lens_of(Torus{12.0, 12.0, 0.0}, plane, 3.0),                   // a sphere
            lens_of(Torus{6.0, 12.0, 0.3}, plane, 3.0),                    // ring to spindle
            lens_of(Torus{-9.0, 7.0, 1.0, Torus::Revolve::v}, plane, 3.0)}},
          {"splines",
           {lens_of(wave, lenses::Sphere{2.0}, 4.0), lens_of(small, lenses::Sphere{6.0}, 2.0),
            grazing(lens_of(wave, lenses::Sphere{9.0}, 6.0)), grazing(lens_of(small, lenses::Sphere{1.0}, 1.0))}},
          {"absurd",
           {support::absurd_lens(random), support::absurd_lens(random), support::absurd_lens(random),
            support::absurd_lens(random)}}};
}

// A wall 5 cm away to the left, one through the lens itself above, a far one to the right, sky between.
render::Scene near_and_far() {
  render::Scene scene = support::dark_scene();
  scene.environment.sky_horizon = scene.environment.sky_zenith = glm::vec3(0.5F);
  const auto wall = support::add_material(scene, support::matte(glm::vec3(0.8F)));
  support::add_wall(scene, wall, -0.05F, 0.0F, 0.05F, 0.04F);
  support::add_wall(scene, wall, 0.0F, 0.02F, 0.01605F, 0.012F);
  support::add_wall(scene, wall, 800.0F, 0.0F, 1000.0F, 500.0F);
  support::add_sun(scene, {0.2F, -0.5F, -1.0F}, 3.0F);
  return scene;
}

class HardDof : public testing::TestWithParam<std::size_t> {};

TEST_P(HardDof, EverySampleIsLight) {
  const Group group = groups()[GetParam()];
  render::vk::Device device;
  render::Renderer renderer(device, near_and_far());
  lenses::LensModel model;
  std::vector<render::ViewSetup> views;
  for (std::size_t i = 0; i < group.lenses.size(); ++i) {
    lenses::Eye eye;
    eye.power = lenses::Refraction{i % 2 == 0 ? -25.0 : 20.0, -6.0, 0.8};
    support::WornPair pair;
    pair.lens[0] = lenses::append_lens(model, &group.lenses[i], lenses::Side::right, eye.entrance_pupil_depth);
    pair.eyes[0].eye = lenses::make_eye_data(eye, 8.0, 0.008);
    views.push_back(support::view_along(pair, 0, render::Viewing::gaze,
                                        tracking::direction_from_yaw_pitch(0.5, i == 3 ? 0.7 : 0.0),
                                        {0.9, 0.9, 0.9, 0.9}));
  }
  render::FrameConfig config;
  config.width = config.height = 48;
  config.mode = render::Mode::dof;
  config.samples = 32;
  config.keep_radiance = config.keep_wavefront = true;
  for (const bool own_focus : {false, true}) {
    for (render::ViewSetup& view : views) {
      view.accommodation = own_focus ? std::nullopt : std::optional(4.0);
      view.viewing = own_focus ? render::Viewing::scanning : render::Viewing::gaze;
    }
    const auto frame = renderer.render(model, views, config);
    EXPECT_TRUE(std::isfinite(frame.error_estimate));
    for (std::size_t v = 0; v < views.size(); ++v) {
      SCOPED_TRACE(testing::Message() << group.name << " " << v << (own_focus ? ", scanning" : ", gaze"));
      const auto unsound = [](float x) { return !std::isfinite(x) || x < 0.0F; };
      EXPECT_EQ(std::ranges::count_if(frame.views[v].radiance, unsound), 0);
      EXPECT_GT(std::ranges::max(frame.views[v].radiance), 0.0F);
      for (const auto* plane : {&frame.views[v].wavefront.v_hh, &frame.views[v].wavefront.v_hv,
                                &frame.views[v].wavefront.accommodation, &frame.views[v].wavefront.blur}) {
        EXPECT_TRUE(std::ranges::all_of(*plane, [](float x) { return std::isfinite(x); }));
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Groups, HardDof, testing::Range(std::size_t{0}, groups().size()));

}  // namespace
