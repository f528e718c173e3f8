// The built-in scene: its targets stand where they are said to, its charts have the sizes their standards ask for, its
// triangles are sound, and none of the charts hides another.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <set>
#include <string>

#include "assets/generator/charts.hpp"
#include "assets/generator/glb_writer.hpp"
#include "assets/generator/ink.hpp"
#include "assets/generator/optotypes.hpp"
#include "assets/generator/planar_fill.hpp"
#include "assets/generator/reading_room.hpp"

namespace {

using assets::Contour;
using assets::FlatShape;

constexpr double kArcMinute = std::numbers::pi / 180.0 / 60.0;

const assets::SceneModel& room() {
  static const assets::SceneModel scene = assets::make_reading_room(VERGENCE_SERIF_FONT);
  return scene;
}

double area(const FlatShape& shape) {
  double sum = 0.0;
  for (std::size_t i = 0; i < shape.indices.size(); i += 3) {
    const glm::dvec2 a = shape.points[shape.indices[i]], b = shape.points[shape.indices[i + 1]],
                     c = shape.points[shape.indices[i + 2]];
    const double twice = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    EXPECT_GT(twice, 0.0) << "a triangle is clockwise or empty";
    sum += 0.5 * twice;
  }
  return sum;
}

struct Extent {
  glm::dvec2 low{1e9}, high{-1e9};
  void include(const glm::dvec2& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
};

Extent extent(const FlatShape& shape) {
  Extent e;
  for (const glm::dvec2& p : shape.points) e.include(p);
  return e;
}

TEST(PlanarFill, HolesAndOverlaps) {
  const Contour square{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, hole{{1, 1}, {1, 3}, {3, 3}, {3, 1}};
  EXPECT_NEAR(area(assets::fill(std::vector{square, hole})), 12.0, 1e-12);
  // Two bars that cross: the union, its middle once.
  const Contour upright{{1, 0}, {2, 0}, {2, 5}, {1, 5}}, slanted{{0, 1}, {5, 2}, {5, 3}, {0, 2}};
  EXPECT_NEAR(area(assets::fill(std::vector{upright, slanted})), 5.0 + 5.0 - 1.0, 1e-12);
}

TEST(Optotypes, EveryLetterFillsItsSquareAndHasItsArea) {
  for (const char letter : assets::kSloanLetters) {
    const FlatShape shape = assets::fill(assets::sloan_letter(letter));
    const Extent e = extent(shape);
    EXPECT_NEAR(e.low.x, 0.0, 1e-9) << letter;
    EXPECT_NEAR(e.low.y, 0.0, 1e-9) << letter;
    EXPECT_NEAR(e.high.y, 5.0, 1e-9) << letter;
    // The C's gap opens on its right: its tips lie on the circle.
    EXPECT_NEAR(e.high.x, letter == 'C' ? 2.5 + std::sqrt(6.0) : 5.0, 1e-9) << letter;
  }
  // Closed forms; polygons of 7.5 degrees lose 0.3 % of a circle.
  EXPECT_NEAR(area(assets::fill(assets::sloan_letter('H'))), 13.0, 1e-9);
  EXPECT_NEAR(area(assets::fill(assets::sloan_letter('O'))), std::numbers::pi * 4.0, 0.04);
  EXPECT_NEAR(area(assets::fill(assets::sloan_letter('Z'))), 10.0 + 1.25 * 3.0, 1e-9);
}

TEST(Optotypes, LandoltRingHasAGapOfOneStrokeInTheDirectionAsked) {
  for (int eighth = 0; eighth < 8; ++eighth) {
    const double angle = eighth * std::numbers::pi / 4.0;
    const auto contours = assets::landolt_ring(angle);
    const glm::dvec2 along(std::cos(angle), std::sin(angle)), across(-along.y, along.x);
    double gap = 1e9, outer = 0.0;
    for (const glm::dvec2& p : contours[0]) {
      outer = std::max(outer, glm::length(p));
      if (glm::dot(p, along) > 1.0) gap = std::min(gap, 2.0 * std::abs(glm::dot(p, across)));
    }
    EXPECT_NEAR(gap, 1.0, 1e-9);
    EXPECT_NEAR(outer, 2.5, 1e-9);
  }
}

TEST(Optotypes, SizesOfTheTextbook) {
  EXPECT_NEAR(assets::letter_height(0.0, 6.0), 0.008727, 1e-6);
  EXPECT_NEAR(assets::letter_height(0.0, 0.4), 0.000582, 1e-6);
}

TEST(ReadingRoom, TargetsStandAtTheirDistances) {
  const std::map<std::string, double> distances{{"near_card", 0.40}, {"phone", 0.30},      {"screen", 0.70},
                                                {"clock_dial", 4.0}, {"etdrs_chart", 4.0}, {"sign_10m", 10.0},
                                                {"house_50m", 50.0}};
  for (const auto& [name, distance] : distances) {
    const assets::Node& node = room().node(name);
    EXPECT_TRUE(node.target) << name;
    EXPECT_NEAR(glm::distance(node.translation, assets::kEyes), distance, 1e-4) << name;
  }
  EXPECT_TRUE(room().node("window").target);
  EXPECT_GE(glm::distance(room().node("horizon").translation, assets::kEyes), 1e4);  // 1e-4 D or less
  EXPECT_TRUE(room().node("start").camera);
  EXPECT_EQ(room().node("start").translation, assets::kEyes);
}

TEST(ReadingRoom, SheetsFaceTheEyesWithLevelLines) {
  for (const char* name : {"near_card", "phone", "screen", "clock_dial", "etdrs_chart", "sign_10m"}) {
    const assets::Node& node = room().node(name);
    const glm::dvec3 normal = node.rotation * glm::dvec3(0.0, 0.0, 1.0);
    EXPECT_NEAR(glm::distance(normal, glm::normalize(assets::kEyes - node.translation)), 0.0, 1e-12) << name;
    EXPECT_NEAR((node.rotation * glm::dvec3(1.0, 0.0, 0.0)).y, 0.0, 1e-12) << name;
  }
}

// Directions from the eyes to a node's sheet: tangents right and up on the plane z = -1.
Extent seen_from_eyes(const assets::Node& node) {
  Extent e;
  for (const auto& [material, mesh] : node.parts) {
    for (const glm::dvec3& p : mesh.positions) {
      const glm::dvec3 d = node.rotation * p + node.translation - assets::kEyes;
      e.include(glm::dvec2(d.x, d.y) / -d.z);
    }
  }
  return e;
}

TEST(ReadingRoom, NoSheetHidesAnother) {
  const std::vector<std::string> names{"near_card", "phone", "screen", "clock_dial", "etdrs_chart", "sign_10m"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Extent a = seen_from_eyes(room().node(names[i])), b = seen_from_eyes(room().node(names[j]));
      const bool apart = a.low.x > b.high.x || b.low.x > a.high.x || a.low.y > b.high.y || b.low.y > a.high.y;
      EXPECT_TRUE(apart) << names[i] << " and " << names[j];
    }
  }
}

// The ink of a chart: the part whose material's name ends in "_ink".
const assets::Mesh& ink_of(const std::string& node) {
  for (const auto& [material, mesh] : room().node(node).parts) {
    if (room().materials[material].name.ends_with("_ink")) return mesh;
  }
  throw std::out_of_range(node + " has no ink");
}

TEST(ReadingRoom, EtdrsRowsHaveTheirSizesAtFourMetres) {
  const assets::Mesh& ink = ink_of("etdrs_chart");
  // Rows are apart by white space: cut the ink's heights where no triangle reaches.
  std::map<double, double> bands;  // low edge to high edge, merged
  for (std::size_t i = 0; i < ink.indices.size(); i += 3) {
    double low = 1e9, high = -1e9;
    for (std::size_t k = 0; k < 3; ++k) {
      low = std::min(low, ink.positions[ink.indices[i + k]].y);
      high = std::max(high, ink.positions[ink.indices[i + k]].y);
    }
    for (auto it = bands.begin(); it != bands.end();) {
      if (it->first <= high + 1e-6 && low <= it->second + 1e-6) {
        low = std::min(low, it->first);
        high = std::max(high, it->second);
        it = bands.erase(it);
      } else {
        ++it;
      }
    }
    bands[low] = high;
  }
  ASSERT_EQ(bands.size(), assets::kEtdrsRows.size());
  std::size_t row = assets::kEtdrsRows.size();
  double below = 0.0;
  for (const auto& [low, high] : bands) {
    --row;
    const double expected = 4.0 * std::tan(5.0 * std::pow(10.0, 1.0 - 0.1 * static_cast<double>(row)) * kArcMinute);
    EXPECT_NEAR((high - low) / expected, 1.0, 1e-3) << "row " << row;
    if (row + 1 < assets::kEtdrsRows.size()) {
      const double smaller = 4.0 * std::tan(5.0 * std::pow(10.0, 0.9 - 0.1 * static_cast<double>(row)) * kArcMinute);
      EXPECT_NEAR((low - below) / smaller, 1.0, 1e-3) << "gap below row " << row;
    }
    below = high;
  }
}

TEST(ReadingRoom, EtdrsRowsRepeatNoLetterAndUseTheTen) {
  for (const std::string_view row : assets::kEtdrsRows) {
    EXPECT_EQ(row.size(), 5U);
    EXPECT_EQ(std::set<char>(row.begin(), row.end()).size(), 5U) << row;
    for (const char letter : row) EXPECT_NE(assets::kSloanLetters.find(letter), std::string_view::npos) << letter;
  }
}

TEST(ReadingRoom, CardTextHasItsXHeights) {
  const assets::Font font(VERGENCE_SERIF_FONT);
  for (const int points : assets::kCardPoints) {
    const double em = points * 0.0254 / 72.0;
    EXPECT_NEAR(assets::point_size(points), em, 1e-12);
    assets::Mesh mesh;
    assets::add_text(mesh, font, "x", {0.0, 0.0}, em, 0.0, 1.2e-5);
    double low = 1e9, high = -1e9;
    for (const glm::dvec3& p : mesh.positions) {
      low = std::min(low, p.y);
      high = std::max(high, p.y);
    }
    EXPECT_NEAR((high - low) / (0.459 * em), 1.0, 1e-3) << "N" << points;  // the font's x-height, stated to 1e-3 em
  }
}

TEST(ReadingRoom, CardTextStaysOnTheCard) {
  for (const glm::dvec3& p : ink_of("near_card").positions) {
    EXPECT_LT(std::abs(p.x), 0.059);
    EXPECT_LT(std::abs(p.y), 0.041);
    EXPECT_NEAR(p.z, assets::kNearInkLift, 1e-12);
  }
}

TEST(ReadingRoom, TrianglesAreSoundAndFaceTheWayTheirNormalsPoint) {
  EXPECT_GE(room().triangle_count(), 30000U);
  EXPECT_LE(room().triangle_count(), 150000U);
  for (const assets::Node& node : room().nodes) {
    for (const auto& [material, mesh] : node.parts) {
      ASSERT_LT(material, room().materials.size());
      ASSERT_EQ(mesh.positions.size(), mesh.normals.size());
      ASSERT_EQ(mesh.positions.size(), mesh.uvs.size());
      ASSERT_EQ(mesh.indices.size() % 3, 0U);
      for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        ASSERT_TRUE(std::isfinite(glm::length(mesh.positions[i]))) << node.name;
        ASSERT_NEAR(glm::length(mesh.normals[i]), 1.0, 1e-9) << node.name;
      }
      for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        glm::dvec3 p[3], normal(0.0);
        for (std::size_t k = 0; k < 3; ++k) {
          ASSERT_LT(mesh.indices[i + k], mesh.positions.size());
          p[k] = mesh.positions[mesh.indices[i + k]];
          normal += mesh.normals[mesh.indices[i + k]];
        }
        ASSERT_GT(glm::dot(glm::cross(p[1] - p[0], p[2] - p[0]), normal), 0.0) << node.name << " triangle " << i / 3;
      }
    }
  }
}

TEST(ReadingRoom, WrittenTwiceTheBytesAreTheSame) {
  const auto a = assets::glb_bytes(room());
  EXPECT_EQ(a, assets::glb_bytes(assets::make_reading_room(VERGENCE_SERIF_FONT)));
  ASSERT_GT(a.size(), 20U);
  EXPECT_EQ(std::string(a.begin(), a.begin() + 4), "glTF");
  const std::size_t length = a[8] | a[9] << 8 | a[10] << 16 | static_cast<std::size_t>(a[11]) << 24;
  EXPECT_EQ(length, a.size());
}

}  // namespace
