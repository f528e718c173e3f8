// Approximate defocus against distributed rays, 4096 a pixel, in a committed set of views.
//
// VERGENCE_REMAKE_REFERENCES=1 renders tests/golden/references/defocus anew instead of comparing, those alone whose
// test --gtest_filter names; with VERGENCE_REFERENCE_SAMPLES=N by N samples. Half an hour of two cores for all.
// VERGENCE_MATCHING_SAMPLES=1 says besides how many distributed rays come as close as approximate defocus does.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iomanip>
#include <iostream>
#include <string>

#include "render/image/shown_error.hpp"
#include "render/vk/device.hpp"
#include "tests/support/defocus_views.hpp"

namespace {

using render::FrameConfig;
using render::Mode;
using support::DefocusView;

constexpr int kReferenceSamples = 4096;
constexpr int kMostMatched = 256;

class AdofViews : public testing::TestWithParam<DefocusView> {
 protected:
  static void SetUpTestSuite() {
    device_ = new render::vk::Device();
    views_ = new support::DefocusViews(*device_);
  }
  static void TearDownTestSuite() {
    delete views_;
    delete device_;
  }

  static void remake(const DefocusView& view) {
    const char* samples = std::getenv("VERGENCE_REFERENCE_SAMPLES");
    FrameConfig config;
    config.mode = Mode::dof;
    config.samples = samples != nullptr ? std::atoi(samples) : kReferenceSamples;
    const std::filesystem::path file = support::defocus_reference(view);
    std::filesystem::create_directories(file.parent_path());
    support::write_defocus_reference(file, views_->render(view, config).radiance);
  }

  // The least power of two of distributed rays that come this close to the reference; 0: more than kMostMatched.
  static int matching_samples(const DefocusView& view, const std::vector<float>& reference, double psnr_db) {
    FrameConfig config;
    config.mode = Mode::dof;
    config.seed = 1;  // the reference's samples are not these
    for (config.samples = 1; config.samples <= kMostMatched; config.samples *= 2) {
      const auto radiance = views_->render(view, config).radiance;
      if (render::compare_shown(radiance, reference, 1.0, support::defocus_judged()).psnr_db >= psnr_db) {
        return config.samples;
      }
    }
    return 0;
  }

  // Of those that are judged, 1 for the pixels whose blur's major semi-axis is more than 2 px.
  static std::vector<std::uint8_t> blurred(const DefocusView& view, const render::RenderedView& pinhole) {
    std::vector<std::uint8_t> counted = support::defocus_judged();
    const double pixels_a_radian = support::kDefocusSize / (2.0 * std::tan(0.5 * view.fov_deg * support::kDegree));
    for (std::size_t i = 0; i < counted.size(); ++i) {
      if (static_cast<double>(pinhole.wavefront.blur[i]) * pixels_a_radian <= 2.0) counted[i] = 0;
    }
    return counted;
  }

  inline static render::vk::Device* device_ = nullptr;
  inline static support::DefocusViews* views_ = nullptr;
};

// White paper shows 0.8 to 0.9 of full scale in all of them, without exposure. A picture that mixes what is there by
// the right weights differs from the reference by what chief rays do not see: what a near edge hides, and errors of the
// lens beyond defocus and astigmatism.
TEST_P(AdofViews, ComeCloseToDistributedRays) {
  const DefocusView& view = GetParam();
  if (std::getenv("VERGENCE_REMAKE_REFERENCES") != nullptr) {
    remake(view);
    return;
  }
  const std::vector<float> reference = support::read_defocus_reference(support::defocus_reference(view));
  FrameConfig config;
  const render::RenderedView adof = views_->render(view, config);
  config.mode = Mode::pinhole;
  config.keep_wavefront = true;
  const render::RenderedView pinhole = views_->render(view, config);
  const auto judged = support::defocus_judged();
  const auto where_blurred = blurred(view, pinhole);
  const auto psnr = [&](const render::RenderedView& picture, const std::vector<std::uint8_t>& counted) {
    return render::compare_shown(picture.radiance, reference, 1.0, counted).psnr_db;
  };
  const double reached = psnr(adof, judged);
  const double reached_where_blurred = psnr(adof, where_blurred);
  const double unblurred = psnr(pinhole, where_blurred);
  std::cout << std::fixed << std::setprecision(2) << view.name << ": adof " << reached << " dB (whole picture "
            << psnr(adof, {}) << "); where blurred by more than 2 px adof " << reached_where_blurred << ", pinhole "
            << unblurred << "\n";
  if (std::getenv("VERGENCE_MATCHING_SAMPLES") != nullptr) {
    const int samples = matching_samples(view, reference, reached);
    std::cout << view.name << ": as close as "
              << (samples > 0 ? std::to_string(samples) : "more than " + std::to_string(kMostMatched))
              << " samples of dof\n";
  }
  EXPECT_GE(reached, view.least_db);
  EXPECT_GE(reached_where_blurred, unblurred + 12.0);
}

INSTANTIATE_TEST_SUITE_P(, AdofViews, testing::ValuesIn(support::kDefocusViews),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
