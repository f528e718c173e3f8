// Every mode of the renderer in the reading room, a presbyope with and without progressive spectacles, against pictures
// that were looked at, and against what optics says must be there.
//
// VERGENCE_REMAKE_REFERENCES=1 writes tests/golden/references anew instead of comparing; look at each picture before it
// is committed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "render/image/image.hpp"
#include "render/image/png.hpp"
#include "render/vk/device.hpp"
#include "tests/support/worn_views.hpp"

namespace {

using render::FrameConfig;
using render::Mode;
using render::RenderedFrame;
using render::Viewing;
using support::WornPair;

constexpr int kSize = 160;

struct ModeCase {
  Mode mode;
  std::string name;
  double psnr_db;  // against the reference; 0: a map, compared by its largest differences
  std::optional<render::MapRange> range;
};

// Pictures move by rounding only; distributed rays by more, as a ray that falls on the other side of an edge counts as
// a 16th of a pixel. Ranges are fixed so that a colour means the same in both pictures.
const std::vector<ModeCase> kCases{{Mode::pinhole, "pinhole", 40.0, std::nullopt},
                                   {Mode::adof, "adof", 40.0, std::nullopt},
                                   {Mode::dof, "dof", 35.0, std::nullopt},
                                   {Mode::power, "power", 0.0, render::MapRange{-3.0, 0.5}},
                                   {Mode::astigmatism, "astigmatism", 0.0, render::MapRange{0.0, 2.0}},
                                   {Mode::accommodation, "accommodation", 0.0, render::MapRange{0.0, 0.5}},
                                   {Mode::blur, "blur", 0.0, render::MapRange{0.0, 30.0}}};

// Of the differences of the encoded values, in steps of 255.
int percentile_99(const render::Image8& a, const render::Image8& b) {
  std::vector<int> differences;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) {
    differences.push_back(std::abs(int{a.rgb[i]} - int{b.rgb[i]}));
  }
  const auto at = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() * 99 / 100);
  std::ranges::nth_element(differences, at);
  return *at;
}

void compare_with_reference(const render::Image8& image, const std::string& name, double psnr_db) {
  const std::filesystem::path file =
      std::filesystem::path(VERGENCE_TEST_DATA).parent_path() / "golden" / "references" / (name + ".png");
  if (std::getenv("VERGENCE_REMAKE_REFERENCES") != nullptr) {
    render::write_png(file, image);
    return;
  }
  const render::Image8 reference = render::read_png(file);
  ASSERT_EQ(reference.width, image.width);
  ASSERT_EQ(reference.height, image.height);
  if (psnr_db > 0.0) {
    EXPECT_GE(render::compare(image, reference).psnr_db, psnr_db);
  } else {
    // A 40th of the range: less than a viewer can tell from the colour bar.
    EXPECT_LE(percentile_99(image, reference), 6);
  }
}

class RenderModes : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    device_ = new render::vk::Device();
    scene_ = new render::Scene(support::reading_room());
    renderer_ = new render::Renderer(*device_, *scene_);
    spectacles_ = lenses::read_spectacles(VERGENCE_ASSETS "/spectacles/presbyopia_bspline_sphere.json");
  }
  static void TearDownTestSuite() {
    delete renderer_;
    delete scene_;
    delete device_;
  }

  static WornPair worn(bool with_spectacles) {
    const lenses::Wearer wearer = lenses::read_wearer(VERGENCE_ASSETS "/wearers/presbyopia.json");
    return support::wear(wearer, with_spectacles ? &spectacles_ : nullptr, scene_->start_pose().value());
  }

  // The right eye's view of a target.
  static RenderedFrame look_at(const WornPair& pair, const std::string& target, FrameConfig config,
                               Viewing viewing = Viewing::gaze, double fov_deg = 50.0) {
    config.width = config.height = kSize;
    const auto views = support::views_at(pair, viewing, support::target_position(*scene_, target),
                                         tracking::FieldOfView::symmetric(fov_deg * support::kDegree, 1.0));
    return renderer_->render(pair.model, {views[0]}, config);
  }

  static void expect_references(bool with_spectacles, const std::string& name) {
    const WornPair pair = worn(with_spectacles);
    for (const ModeCase& c : kCases) {
      SCOPED_TRACE(c.name);
      FrameConfig config;
      config.mode = c.mode;
      config.samples = 16;
      config.range = c.range;
      // Close enough that a pixel, 5 arcmin, is less than the blur without spectacles, 15; maps show the whole field.
      const double fov_deg = render::is_map(c.mode) ? 50.0 : 14.0;
      const auto frame = look_at(pair, "near_card", config, Viewing::gaze, fov_deg);
      compare_with_reference(frame.views[0].display, name + "_" + c.name, c.psnr_db);
    }
  }

  inline static render::vk::Device* device_ = nullptr;
  inline static render::Scene* scene_ = nullptr;
  inline static render::Renderer* renderer_ = nullptr;
  inline static lenses::Spectacles spectacles_;
};

TEST_F(RenderModes, NearCardThroughProgressiveSpectacles) {
  expect_references(true, "progressive");
}

TEST_F(RenderModes, NearCardWithoutSpectacles) {
  expect_references(false, "bare");
}

constexpr std::size_t kCentre = static_cast<std::size_t>(kSize / 2) * kSize + kSize / 2;

// The mean residual at the picture's centre, D.
double centre_residual(const WornPair& pair, const RenderedFrame& frame) {
  const auto& w = frame.views[0].wavefront;
  const auto& excess = pair.eyes[0].eye.excess;
  return 0.5 * (w.v_hh[kCentre] + w.v_vv[kCentre] + excess.x + excess.z) + w.accommodation[kCentre];
}

// At 62 years the eye accommodates 0.07 D; the card, 0.4 m away, asks for 2.5. The near zone, entered 12 mm below the
// fitting cross, has most of its addition of 2.
TEST_F(RenderModes, APresbyopeNeedsTheNearZoneForTheCard) {
  FrameConfig config;
  config.keep_wavefront = true;
  const WornPair bare = worn(false);
  const WornPair aided = worn(true);
  EXPECT_NEAR(centre_residual(bare, look_at(bare, "near_card", config)), -2.43, 0.03);
  EXPECT_LT(std::abs(centre_residual(aided, look_at(aided, "near_card", config))), 0.5);
  // The distance zone takes nothing away from what is far.
  EXPECT_LT(std::abs(centre_residual(aided, look_at(aided, "etdrs_chart", config))), 0.25);
}

// Spread of the luminance over the middle of the picture: the print's contrast.
double contrast(const render::Image8& image) {
  double sum = 0.0, squares = 0.0;
  int count = 0;
  for (int y = kSize / 4; y < 3 * kSize / 4; ++y) {
    for (int x = kSize / 4; x < 3 * kSize / 4; ++x) {
      const double green = image.rgb[3 * (static_cast<std::size_t>(y) * kSize + static_cast<std::size_t>(x)) + 1];
      sum += green;
      squares += green * green;
      ++count;
    }
  }
  return std::sqrt(std::max(0.0, squares / count - sum * sum / count / count));
}

// Print of the card, close up: sharp through the near zone, washed out without spectacles, for both ways to blur.
TEST_F(RenderModes, PrintIsReadableOnlyThroughTheNearZone) {
  const auto print = [&](bool with_spectacles, Mode mode) {
    FrameConfig config;
    config.mode = mode;
    config.samples = 32;
    return contrast(look_at(worn(with_spectacles), "near_card", config, Viewing::gaze, 6.0).views[0].display);
  };
  const double sharp = print(true, Mode::pinhole);
  for (const Mode mode : {Mode::adof, Mode::dof}) {
    const double aided = print(true, mode);
    const double bare = print(false, mode);
    std::cout << "contrast of the print: pinhole " << sharp << ", aided " << aided << ", bare " << bare << "\n";
    // 0.44 D are left with the spectacles, 2.43 D without: 3 and 15 arcmin, on strokes of 1 to 5.
    EXPECT_GT(aided, 0.4 * sharp);
    EXPECT_LT(bare, 0.5 * aided);
  }
}

// The power of the lens itself, with the scene's distance taken out: V + 1/depth, which holds to within the lens's
// magnification. Looking straight ahead with the eye fixed, the near zone lies at the bottom.
TEST_F(RenderModes, ThePowerMapOfAProgressiveHasItsAdditionAtTheBottom) {
  const WornPair pair = worn(true);
  FrameConfig config;
  config.mode = Mode::power;
  config.keep_wavefront = true;
  config.width = config.height = kSize;
  const auto view = support::view_along(pair, 0, Viewing::scanning, {0.0, 0.0, -1.0},
                                        tracking::FieldOfView::symmetric(80.0 * support::kDegree, 1.0));
  const auto frame = renderer_->render(pair.model, {view}, config);
  // The near zone's inset is 2.5 mm toward the nose, left for the right eye: 4 degrees from the centre of rotation.
  const auto power_at = [&](double right_deg, double up_deg) {
    const double half = std::tan(40.0 * support::kDegree);
    const auto x = static_cast<std::size_t>((0.5 + 0.5 * std::tan(right_deg * support::kDegree) / half) * kSize);
    const auto y = static_cast<std::size_t>((0.5 - 0.5 * std::tan(up_deg * support::kDegree) / half) * kSize);
    const std::size_t at = y * kSize + x;
    const auto& w = frame.views[0].wavefront;
    const double depth = w.depth[at];
    EXPECT_GE(depth, 0.0);
    return 0.5 * (w.v_hh[at] + w.v_vv[at]) + (depth > 0.0 ? 1.0 / depth : 0.0);
  };
  const double top = power_at(0.0, 20.0);
  const double bottom = power_at(-5.0, -32.0);
  EXPECT_NEAR(top, 0.0, 0.15);
  EXPECT_NEAR(bottom - top, 2.0, 0.3);
}

}  // namespace
