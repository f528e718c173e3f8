// Text as pixels, and where they stand before the eyes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/notice/panel_place.hpp"
#include "app/notice/plate.hpp"
#include "app/notice/utf8.hpp"
#include "render/image/srgb.hpp"

namespace {

using app::Plate;
using app::PlateConfig;
using app::PlateLine;
using app::PlatePicture;

PlateConfig fonts() {
  PlateConfig config;
  config.font = VERGENCE_BUILT_ASSETS "/fonts/LiberationSans-Regular.ttf";
  config.bold_font = VERGENCE_BUILT_ASSETS "/fonts/LiberationSans-Bold.ttf";
  return config;
}

const std::uint8_t* pixel(const PlatePicture& picture, int x, int y) {
  return picture.rgba.data() + 4 * (y * picture.width + x);
}

// Rows of the picture that hold a pixel as bright as a letter's core.
std::vector<int> inked_rows(const PlatePicture& picture) {
  std::vector<int> rows;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      if (pixel(picture, x, y)[1] > 200) {
        rows.push_back(y);
        break;
      }
    }
  }
  return rows;
}

TEST(Utf8, TakesEveryLengthApartAndBack) {
  const std::string text = "a \u00e9 \u20ac \U0001F453";
  EXPECT_EQ(app::drawn_characters(text), U"a \u00e9 \u20ac \U0001F453");
  EXPECT_EQ(app::to_utf8(app::drawn_characters(text)), text);
}

TEST(Utf8, BadBytesAreReplacedOneByOne) {
  using namespace std::string_view_literals;
  constexpr char32_t kBad = 0xFFFD;
  EXPECT_EQ(app::drawn_characters("a\xC3"sv), (std::u32string{U'a', kBad}));               // cut off
  EXPECT_EQ(app::drawn_characters("\xC0\xAFz"sv), (std::u32string{kBad, kBad, U'z'}));     // not the shortest
  EXPECT_EQ(app::drawn_characters("\xED\xA0\x80"sv), (std::u32string{kBad, kBad, kBad}));  // a surrogate
  EXPECT_EQ(app::drawn_characters("\xF5"sv), std::u32string{kBad});
  EXPECT_EQ(app::drawn_characters("a\nb\tc\0d"sv), U"a b c d");
}

TEST(Plate, LettersHaveTheHeightAskedFor) {
  PlateConfig config = fonts();
  config.x_height = 40.0;
  const auto rows = inked_rows(Plate(config).draw({{.text = "xxxx"}}));
  ASSERT_FALSE(rows.empty());
  // A row at either end may be covered in part only.
  EXPECT_NEAR(rows.back() - rows.front() + 1, 40.0, 2.0);
}

TEST(Plate, IsDarkTranslucentAndMultipliedByItsOpacity) {
  const PlatePicture picture = Plate(fonts()).draw({{"Pair", "progressive"}});
  constexpr int kIn = PlatePicture::kBorder;
  EXPECT_EQ(pixel(picture, kIn, kIn)[3], 0) << "round corners";
  EXPECT_EQ(pixel(picture, picture.width - 1 - kIn, picture.height - 1 - kIn)[3], 0);
  EXPECT_EQ(pixel(picture, picture.width / 2, kIn - 1)[3], 0) << "the border";
  EXPECT_EQ(pixel(picture, picture.width - kIn, picture.height / 2)[3], 0);
  const std::uint8_t* ground = pixel(picture, picture.width / 2, kIn);
  EXPECT_NEAR(ground[3], 255 * Plate(fonts()).config().opacity, 1.0);
  std::uint8_t brightest = 0;
  for (int i = 0; i < picture.width * picture.height; ++i) {
    const std::uint8_t* p = picture.rgba.data() + 4 * i;
    brightest = std::max(brightest, p[0]);
    for (int channel = 0; channel < 3; ++channel) {
      // Multiplied: no light can exceed the opacity, to the rounding of both bytes.
      ASSERT_LE(render::srgb_decode(p[channel]), p[3] / 255.0F + 0.01F) << "pixel " << i;
    }
  }
  EXPECT_GT(brightest, 220);
  EXPECT_LT(ground[0], 25);
}

TEST(Plate, LongTextIsBrokenAndCutWithinTheMostAllowed) {
  const Plate plate(fonts());
  std::string words, word(400, 'w');
  for (int i = 0; i < 200; ++i) {
    words += "word ";
  }
  const PlatePicture one = plate.draw({{.text = "word"}});
  const PlatePicture broken = plate.draw({{.text = words}});
  EXPECT_LE(broken.width, plate.config().most_width);
  EXPECT_GT(broken.width, 3 * plate.config().most_width / 4);
  // Three rows, then an ellipsis: two line steps of 2.5 letters more than one row.
  EXPECT_EQ(broken.height, one.height + static_cast<int>(2 * 2.5 * plate.config().x_height));
  EXPECT_EQ(plate.draw({{.text = word}}).height, broken.height);
  const PlatePicture many = plate.draw(std::vector<PlateLine>(200, {"Warning", words, PlateLine::Kind::warning}));
  EXPECT_LE(many.height, plate.config().most_height);
}

TEST(Plate, AnyNameCanBeDrawn) {
  const Plate plate(fonts());
  for (const char* name :
       {"Gleitsicht Grün, Größe ½", "Очки для чтения", "\xFF\xFE\xC3", "眼鏡 老視", "", "\U0001F453"}) {
    const PlatePicture picture = plate.draw({{"Pair", name}});
    EXPECT_GT(picture.width, 0) << name;
    EXPECT_EQ(picture.rgba.size(),
              4 * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
  }
  EXPECT_GT(plate.draw({}).height, 0);
}

constexpr double kDegree = std::numbers::pi / 180.0;

std::array<tracking::EyeView, 2> headset_views(double half_deg, double cant_deg) {
  std::array<tracking::EyeView, 2> views;
  for (const double side : {1.0, -1.0}) {  // right, left
    tracking::EyeView& view = views[side > 0.0 ? 0 : 1];
    view.head_from_view = {tracking::orientation_from_yaw_pitch(side * cant_deg * kDegree, 0.0), {side * 0.0315, 0, 0}};
    const double t = std::tan(half_deg * kDegree);
    view.fov = {t, t, t, t};
  }
  return views;
}

void expect_seen(const app::PanelPlace& place, const std::array<tracking::EyeView, 2>& views) {
  for (const tracking::EyeView& view : views) {
    for (const double x : {-0.5, 0.5}) {
      for (const double y : {-0.5, 0.5}) {
        const glm::dvec3 p =
            view.head_from_view.inverse().point(place.head_from_panel.point({x * place.width, y * place.height, 0}));
        ASSERT_LT(p.z, 0.0);
        EXPECT_LT(p.x / -p.z, view.fov.tan_right);
        EXPECT_GT(p.x / -p.z, -view.fov.tan_left);
        EXPECT_LT(p.y / -p.z, view.fov.tan_up);
        EXPECT_GT(p.y / -p.z, -view.fov.tan_down);
      }
    }
  }
}

TEST(PanelPlace, StandsLowFacesTheHeadAndHasTheAngleWishedFor) {
  const auto views = headset_views(50.0, 5.0);
  const auto place = app::place_panel(views, {.distance = 1.5, .width = 25 * kDegree, .height = 5 * kDegree});
  const glm::dvec3 at = place.head_from_panel.position;
  EXPECT_NEAR(glm::length(at), 1.5, 1e-12);
  EXPECT_NEAR(std::atan2(at.y, -at.z) / kDegree, -17.5, 1e-9);
  EXPECT_NEAR(glm::dot(place.head_from_panel.direction({0, 0, 1}), -at / 1.5), 1.0, 1e-12);
  EXPECT_NEAR(2.0 * std::atan(place.width / 2.0 / 1.5) / kDegree, 25.0, 1e-9);
  EXPECT_NEAR(2.0 * std::atan(place.height / 2.0 / 1.5) / kDegree, 5.0, 1e-9);
  expect_seen(place, views);
}

TEST(PanelPlace, BothEyesSeeAllOfItInAnyHeadset) {
  for (const double half_deg : {10.0, 20.0, 35.0, 60.0}) {
    for (const double cant_deg : {0.0, 10.0}) {
      for (const double distance : {0.3, 1.5, 1e6}) {
        const auto views = headset_views(half_deg, half_deg > 15.0 ? cant_deg : 0.0);
        const auto place =
            app::place_panel(views, {.distance = distance, .width = 60 * kDegree, .height = 30 * kDegree});
        SCOPED_TRACE(testing::Message() << half_deg << " deg, cant " << cant_deg << ", " << distance << " m");
        expect_seen(place, views);
        EXPECT_GT(place.width, 1.5 * place.height) << "its shape is kept";
      }
    }
  }
}

TEST(PanelPlace, LettersHaveTwelvePixelsAndAreNeverTiny) {
  EXPECT_NEAR(app::letter_angle(20.0) / kDegree, 0.6, 1e-12);
  EXPECT_NEAR(app::letter_angle(60.0) / kDegree, 0.4, 1e-12);
}

}  // namespace
