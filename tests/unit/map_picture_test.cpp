// Isolines, scales and tables of reports, and the picture they become.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "app/report/csv.hpp"
#include "app/report/map_picture.hpp"
#include "app/report/text.hpp"
#include "render/image/draw.hpp"

namespace {

using app::GridField;
using app::Isoline;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

template <class F>
GridField sampled(double half_width, std::size_t points, const F& f) {
  GridField field{lenses::square_grid(half_width, points), {}, {}};
  for (std::size_t i = 0; i < field.grid.count(); ++i) {
    field.values.push_back(f(field.grid.at(i)));
  }
  return field;
}

double length_of(const Isoline& line) {
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
    length += glm::distance(line.points[i], line.points[i + 1]);
  }
  return length;
}

TEST(Isolines, OfAConeAreCirclesOfTheirLevel) {
  const GridField cone = sampled(10.0, 101, [](const glm::dvec2& p) { return glm::length(p); });
  for (const double level : {2.0, 5.0, 9.0}) {
    const auto lines = isolines(cone, level, 0.02);
    ASSERT_EQ(lines.size(), 1U) << level;
    EXPECT_EQ(lines.front().points.front(), lines.front().points.back()) << "closed";
    for (const glm::dvec2& p : lines.front().points) {
      // Linear between samples 0.2 apart: off by h^2/(8 r) at most.
      EXPECT_NEAR(glm::length(p), level, 0.2 * 0.2 / (8.0 * level) + 1e-9);
    }
    EXPECT_NEAR(length_of(lines.front()), 2.0 * std::numbers::pi * level, 0.02 * level);
  }
}

TEST(Isolines, OpenLinesRunFromEdgeToEdge) {
  const GridField slope = sampled(1.0, 21, [](const glm::dvec2& p) { return p.x + 0.25 * p.y; });
  const auto lines = isolines(slope, 0.03, 0.01);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NEAR(length_of(lines.front()), 2.0 * std::hypot(1.0, 0.25), 1e-9);
}

TEST(Isolines, ASaddleHasTwoBranches) {
  const GridField saddle = sampled(1.0, 40, [](const glm::dvec2& p) { return p.x * p.y; });
  EXPECT_EQ(isolines(saddle, 0.1, 0.01).size(), 2U);
  EXPECT_EQ(isolines(saddle, -0.1, 0.01).size(), 2U);
}

TEST(Isolines, FollowNoRipplesOfAPlateau) {
  const auto plateau = [](const glm::dvec2& p) {
    return std::max(0.0, p.x) + 1e-3 * std::sin(40.0 * p.x) * std::sin(40.0 * p.y);
  };
  const GridField field = sampled(1.0, 101, plateau);
  EXPECT_TRUE(isolines(field, 0.0, 0.02).empty());
  EXPECT_EQ(isolines(field, 0.5, 0.02).size(), 1U);
}

TEST(Isolines, StopWhereValuesEndAndAtZones) {
  GridField field = sampled(1.0, 21, [](const glm::dvec2& p) { return p.x < 0.55 ? p.y : kNone; });
  for (const Isoline& line : isolines(field, 0.02, 0.01)) {
    for (const glm::dvec2& p : line.points) {
      EXPECT_LT(p.x, 0.55);
    }
  }
  // A jump of 5 between zones is no crowd of lines.
  field = sampled(1.0, 21, [](const glm::dvec2& p) { return p.y < 0.05 ? p.x : p.x + 5.0; });
  for (std::size_t i = 0; i < field.grid.count(); ++i) {
    field.zones.push_back(field.grid.at(i).y < 0.05 ? 0 : 1);
  }
  EXPECT_TRUE(isolines(field, 2.5, 0.01).empty());
}

TEST(ValueAt, InterpolatesWithinItsZoneOnly) {
  GridField field{lenses::Grid{{0.0, 0.0}, {1.0, 1.0}, 2, 2}, {0.0, 1.0, 10.0, 11.0}, {}};
  EXPECT_NEAR(value_at(field, {0.25, 0.5}), 5.25, 1e-7);
  EXPECT_TRUE(std::isnan(value_at(field, {1.5, 0.5})));
  field.zones = {0, 0, 1, 1};
  const auto upper = [](const glm::dvec2& p) { return p.y > 0.4 ? 1 : 0; };
  EXPECT_NEAR(value_at(field, {0.25, 0.39}, upper), 0.25, 1e-7);
  EXPECT_NEAR(value_at(field, {0.25, 0.41}, upper), 10.25, 1e-7);
  field.zones.clear();
  field.values[3] = kNone;
  EXPECT_NEAR(value_at(field, {0.0, 0.5}), 5.0, 1e-6) << "what is missing has no weight";
}

TEST(Grown, FillsASampleFromItsNeighboursOnce) {
  GridField field{lenses::Grid{{0.0, 0.0}, {3.0, 1.0}, 4, 2}, {2.0, kNone, kNone, kNone, 4.0, kNone, kNone, kNone}, {}};
  const GridField once = grown(field, 1);
  EXPECT_EQ(once.values[1], 3.0);
  EXPECT_EQ(once.values[5], 3.0);
  EXPECT_TRUE(std::isnan(once.values[2]));
  EXPECT_EQ(grown(field, 2).values[2], 3.0);
  EXPECT_TRUE(std::isnan(grown(field, 2).values[3]));
}

TEST(MapScale, IsRoundAndHasRoomForItsLines) {
  std::vector<double> values;
  for (int i = 0; i <= 1000; ++i) {
    values.push_back(-0.30 + 2.52 * i / 1000.0);
  }
  app::MapScale scale = app::map_scale(values, 0.25);
  EXPECT_EQ(scale.step, 0.25);
  EXPECT_NEAR(scale.low, -0.5, 1e-12);
  EXPECT_NEAR(scale.high, 2.25, 1e-12);
  for (double& v : values) {
    v *= 10.0;
  }
  scale = app::map_scale(values, 0.25);
  EXPECT_EQ(scale.step, 2.5);
  // One value is no map of rounding errors; what cannot be negative has no negative colours.
  scale = app::map_scale({3.0, 3.0, 3.0 + 1e-13}, 0.25);
  EXPECT_GE(scale.high - scale.low, 0.75);
  EXPECT_EQ(app::map_scale({0.0, 0.1}, 0.25).low, 0.0);
  // Numbers of any size end: neither too many lines nor steps that no longer show.
  for (const double huge : {1e8, -1e17, 1e300}) {
    scale = app::map_scale({huge, huge}, 0.25);
    EXPECT_GT(scale.high, scale.low);
    scale = app::map_scale({-huge, 0.0, huge}, 0.25);
    EXPECT_LE((scale.high - scale.low) / scale.step, 26.0);
  }
  scale = app::map_scale({kNone}, 0.25);
  EXPECT_LT(scale.low, scale.high);
}

app::MapPicture small_map() {
  app::MapPicture map;
  map.title = std::string("Test");
  map.unit = std::string("D");
  map.field = sampled(10.0, 41, [](const glm::dvec2& p) { return p.x; });
  map.scale = {-10.0, 10.0, 5.0};
  map.region = {{-8.0, -8.0}, {8.0, -8.0}, {8.0, 8.0}, {-8.0, 8.0}};
  return map;
}

render::Rgb colour_at(const render::Image8& image, int x, int y) {
  const std::size_t at =
      3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x));
  return {image.rgb[at], image.rgb[at + 1], image.rgb[at + 2]};
}

int sum(const render::Rgb& c) {
  return c.r + c.g + c.b;
}

TEST(DrawMap, HasItsHighEndAtTheRightAndMirroredAtTheLeft) {
  app::MapPicture map = small_map();
  const render::Image8 wearer = draw_map(map);
  map.mirrored = true;
  const render::Image8 examiner = draw_map(map);
  ASSERT_EQ(wearer.width, examiner.width);
  // Within the plot, off its isolines: a quarter and three quarters of the way.
  const int middle = 92 + 330, y = 72 + 300;
  EXPECT_GT(sum(colour_at(wearer, middle + 215, y)), sum(colour_at(wearer, middle - 215, y)));
  EXPECT_LT(sum(colour_at(examiner, middle + 215, y)), sum(colour_at(examiner, middle - 215, y)));
  // Outside the region nothing is coloured.
  EXPECT_EQ(sum(colour_at(wearer, 92 + 20, y)), 3 * 255);
}

TEST(DrawLine, CoversAsManyPixelsAsItIsLongAndThick) {
  render::Image8 image = render::black_image(60, 60);
  render::draw_line(image, {10.0, 12.0}, {50.0, 42.0}, 3.0, {255, 255, 255});
  double covered = 0.0;
  for (const std::uint8_t value : image.rgb) {
    covered += value / (3.0 * 255.0);
  }
  EXPECT_NEAR(covered, 50.0 * 3.0 + 9.0 * std::numbers::pi / 4.0, 5.0);  // round ends
  render::draw_line(image, {-1e9, 5.0}, {1e9, 5.0}, 1.0, {255, 0, 0});
  EXPECT_NEAR(colour_at(image, 30, 4).r, 128, 1) << "between two rows, half on each";
  render::draw_line(image, {kNone, 5.0}, {20.0, 5.0}, 1.0, {0, 255, 0});
  EXPECT_EQ(colour_at(image, 20, 5).g, 0);
}

TEST(Csv, CellsAndQuotes) {
  app::Csv csv("a,b,c");
  csv.add("plain").add("say \"x, y\"").add(1.5);
  csv.end_row();
  csv.empty(2).add(-1e-12);
  csv.end_row();
  csv.add(std::nullopt).add(kNone).add(1e300);
  csv.end_row();
  const std::string text = csv.text();
  EXPECT_TRUE(text.starts_with("a,b,c\nplain,\"say \"\"x, y\"\"\",1.500000\n,,0.000000\n,,1")) << text;
  EXPECT_TRUE(text.ends_with(".000000\n"));
}

TEST(Text, ZeroHasNoSign) {
  EXPECT_EQ(app::signed_number(-0.001, 2), "0.00");
  EXPECT_EQ(app::signed_number(0.006, 2), "+0.01");
  EXPECT_EQ(app::signed_number(-2.25, 2), "-2.25");
  EXPECT_EQ(app::signed_number(std::nullopt, 2), "-");
  EXPECT_EQ(app::number(-0.0, 1), "0.0");
  EXPECT_EQ(app::number(-12.34, 1), "-12.3");
}

}  // namespace
