// What approximate defocus costs and how close it comes: adof_bench [ROUNDS [SAMPLES]]. Before the views that it is
// judged by, milliseconds of a pinhole frame, of an adof frame and of its blur stage, medians of interleaved rounds.
// Then print under blurs of a few pixels and less, which those views hardly have, by PSNR against SAMPLES distributed
// rays.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "render/image/shown_error.hpp"
#include "render/vk/device.hpp"
#include "tests/support/defocus_views.hpp"

namespace {

using render::FrameConfig;
using render::Mode;
using support::DefocusView;

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

double stage_sum(const render::RenderedFrame& frame, std::string_view name = {}) {
  double sum = 0.0;
  for (const render::vk::StageTime& stage : frame.stages) {
    sum += name.empty() || stage.name == name ? stage.milliseconds : 0.0;
  }
  return sum;
}

void print_times(support::DefocusViews& views, int rounds) {
  std::printf("%-22s %9s %9s %9s %9s\n", "ms", "pinhole", "adof", "ratio", "blur");
  for (const DefocusView& view : support::kDefocusViews) {
    std::vector<double> pinhole, adof, blur;
    for (int round = -1; round < rounds; ++round) {
      FrameConfig config;
      const render::RenderedFrame blurred = views.frame(view, config);
      config.mode = Mode::pinhole;
      const render::RenderedFrame sharp = views.frame(view, config);
      if (round >= 0) {
        pinhole.push_back(stage_sum(sharp));
        adof.push_back(stage_sum(blurred));
        blur.push_back(stage_sum(blurred, "blur"));
      }
    }
    std::printf("%-22s %9.2f %9.2f %9.2f %9.2f\n", view.name, median(pinhole), median(adof),
                median(adof) / median(pinhole), median(blur));
  }
}

// The far chart before a myope, whose blur is in proportion to the refraction beyond the chart's own vergence.
void print_narrow_blurs(support::DefocusViews& views, int samples) {
  constexpr double kChart = 0.25, kPixelsADioptre = 4.27;  // D
  DefocusView view = *std::ranges::find(support::kDefocusViews, std::string_view("text_far"), &DefocusView::name);
  const double pixels_a_radian = support::kDefocusSize / (2.0 * std::tan(0.5 * view.fov_deg * support::kDegree));
  std::printf("%-22s %9s %9s\n", "blur px", "adof dB", "pinhole");
  for (const double blur_px : {0.6, 0.7, 0.8, 0.9, 1.0, 1.2, 1.4, 1.7, 2.0, 2.5, 3.0, 4.0}) {
    view.sphere = -kChart - blur_px / kPixelsADioptre;
    FrameConfig config;
    const auto adof = views.render(view, config);
    config.mode = Mode::pinhole;
    config.keep_wavefront = true;
    const auto pinhole = views.render(view, config);
    config.mode = Mode::dof;
    config.samples = samples;
    const auto reference = views.render(view, config);
    const auto psnr = [&](const render::RenderedView& picture) {
      return render::compare_shown(picture.radiance, reference.radiance, 1.0, support::defocus_judged()).psnr_db;
    };
    const double drawn_px = median({pinhole.wavefront.blur.begin(), pinhole.wavefront.blur.end()}) * pixels_a_radian;
    std::printf("%-22.2f %9.2f %9.2f\n", drawn_px, psnr(adof), psnr(pinhole));
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 7;
  const int samples = argc > 2 ? std::atoi(argv[2]) : 256;
  render::vk::Device device;
  support::DefocusViews views(device);
  if (rounds > 0) {
    print_times(views, rounds);
  }
  if (samples > 0) {
    print_narrow_blurs(views, samples);
  }
}
