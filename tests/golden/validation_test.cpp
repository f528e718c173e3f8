// The validation layers, synchronisation checks among them, have nothing to say about a run of every mode.
#include <gtest/gtest.h>

#include "render/gpu_tracer.hpp"
#include "render/vk/device.hpp"
#include "tests/support/worn_views.hpp"

namespace {

using render::Mode;

// A warning without its cause in view is worth little: all of them are printed.
void expect_silence(const render::vk::Device& device) {
  for (const std::string& message : device.validation_messages()) {
    ADD_FAILURE() << message;
  }
}

TEST(Validation, IsSilentOverEveryMode) {
  render::vk::Device device({.validation = true});
  {
    const render::Scene scene = support::reading_room();
    render::Renderer renderer(device, scene);
    const auto spectacles = lenses::read_spectacles(VERGENCE_ASSETS "/spectacles/presbyopia_bspline_torus.json");
    const auto pair = support::wear(lenses::Wearer{}, &spectacles, scene.start_pose().value());
    const auto views = support::views_at(pair, render::Viewing::gaze, support::target_position(scene, "near_card"),
                                         tracking::FieldOfView::symmetric(50.0 * support::kDegree, 1.0));
    for (const Mode mode : {Mode::pinhole, Mode::adof, Mode::dof, Mode::power, Mode::astigmatism, Mode::accommodation,
                            Mode::blur, Mode::adof}) {
      for (const bool keep : {false, true}) {
        render::FrameConfig config;
        config.width = keep ? 33 : 24;  // the buffers change size in between
        config.height = 20;
        config.mode = mode;
        config.samples = 10;  // more than one submission
        config.keep_radiance = keep && !render::is_map(mode);
        config.keep_wavefront = keep;
        static_cast<void>(renderer.render(pair.model, views, config));
      }
    }
    expect_silence(device);
  }
  expect_silence(device);  // nor when everything has been destroyed
}

TEST(Validation, IsSilentOverATraceOfRays) {
  render::vk::Device device({.validation = true});
  lenses::TraceBatch batch;
  lenses::TraceRequest request;
  request.lens = lenses::read_spectacles(VERGENCE_ASSETS "/spectacles/presbyopia_bspline_torus.json").lens[0];
  for (int i = 0; i < 100; ++i) {
    request.direction = {0.01 * i - 0.5, 0.02, -1.0};
    lenses::append_request(batch, request);
  }
  EXPECT_EQ(render::GpuTracer(device).trace(batch).size(), 100U);
  expect_silence(device);
}

}  // namespace
