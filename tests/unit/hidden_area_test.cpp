// From hidden triangles to pixels: what is hidden is never too much.
#include "tracking/hidden_area.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace {

using tracking::FieldOfView;
using tracking::HiddenArea;
using tracking::PixelMask;

// A square that reaches from (-1, -1) to (1, 1).
constexpr FieldOfView kSquare{1.0, 1.0, 1.0, 1.0};
// A canted display's: its axis is far from the middle of its picture.
constexpr FieldOfView kLopsided{1.4, 0.3, 0.5, 1.1};

int count(const PixelMask& mask) {
  return static_cast<int>(std::lround(mask.hidden_fraction() * mask.width * mask.height));
}

TEST(HiddenArea, NothingHidesNothing) {
  EXPECT_EQ(count(tracking::hidden_pixels({}, kSquare, 7, 5)), 0);
}

// The upper right quarter of the field, either way round, of pixels four to the tangent.
TEST(HiddenArea, UpAndRightAreUpAndRight) {
  for (const bool clockwise : {false, true}) {
    HiddenArea area{{{{{0, 0}, {1, 0}, {1, 1}}}, {{{0, 0}, {1, 1}, {0, 1}}}}};
    if (clockwise) {
      std::swap(area.triangles[0][1], area.triangles[0][2]);
    }
    const PixelMask mask = tracking::hidden_pixels(area, kSquare, 8, 8);
    for (int y = 0; y < 8; ++y) {
      for (int x = 0; x < 8; ++x) {
        EXPECT_EQ(mask.at(x, y), x >= 4 && y < 4) << x << " " << y;
      }
    }
  }
}

// Pixels on the common side of two triangles are in neither whole, but in both together; pixels of which a part shows
// are seen.
TEST(HiddenArea, APixelIsHiddenWhereTrianglesHideAllOfItTogether) {
  const HiddenArea quad{{{{{-0.8, -0.8}, {0.8, -0.8}, {0.8, 0.8}}}, {{{-0.8, -0.8}, {0.8, 0.8}, {-0.8, 0.8}}}}};
  // Twice the same triangle is no more than once: area alone must not be added up.
  const HiddenArea twice{{quad.triangles[0], quad.triangles[0]}};
  // Pixels of 0.25: the border's reach from 0.75 to 1.
  const PixelMask whole = tracking::hidden_pixels(quad, kSquare, 8, 8);
  EXPECT_EQ(count(whole), 36);
  EXPECT_FALSE(whole.at(0, 4));
  EXPECT_TRUE(whole.at(1, 6));
  EXPECT_TRUE(whole.at(3, 4));  // on the diagonal
  const PixelMask half = tracking::hidden_pixels(twice, kSquare, 8, 8);
  EXPECT_FALSE(half.at(3, 4));
  EXPECT_TRUE(half.at(4, 4));
  EXPECT_EQ(count(half), 15);
}

// A fan around a disc, as runtimes make them: what is hidden is all but the pixels that the disc touches, in any field.
TEST(HiddenArea, AroundADiscEveryPixelThatItTouchesIsSeen) {
  for (const FieldOfView& fov : {kSquare, kLopsided}) {
    const glm::dvec2 centre(0.5 * (fov.tan_right - fov.tan_left), 0.5 * (fov.tan_up - fov.tan_down));
    const double radius = 0.7;
    constexpr int kParts = 64, kWidth = 61, kHeight = 47;
    HiddenArea area;
    const auto at = [&](int i, double r) {
      const double angle = 2.0 * M_PI * i / kParts;
      return centre + r * glm::dvec2(std::cos(angle), std::sin(angle));
    };
    const double inscribed = radius / std::cos(M_PI / kParts);  // the polygon's sides touch the disc
    for (int i = 0; i < kParts; ++i) {
      area.triangles.push_back({at(i, inscribed), at(i, 4.0), at(i + 1, 4.0)});
      area.triangles.push_back({at(i, inscribed), at(i + 1, 4.0), at(i + 1, inscribed)});
    }
    const PixelMask mask = tracking::hidden_pixels(area, fov, kWidth, kHeight);
    int seen_by_need = 0;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const auto tangent = [&](double u, double v) {
          return glm::dvec2(-fov.tan_left + u * (fov.tan_left + fov.tan_right) / kWidth,
                            fov.tan_up - v * (fov.tan_down + fov.tan_up) / kHeight);
        };
        const glm::dvec2 low = tangent(x, y + 1), high = tangent(x + 1, y);
        const glm::dvec2 nearest = glm::clamp(centre, low, high);
        const glm::dvec2 farthest = glm::max(glm::abs(low - centre), glm::abs(high - centre));
        // Between disc and polygon lies 0.12 % of the radius; what is nearer than that is left open, and so is a pixel
        // of which less than 0.01 of its side shows (1e-4 of its area counts as none).
        if (glm::length(nearest - centre) < radius - 0.01 * (high.x - low.x)) {
          ++seen_by_need;
          EXPECT_FALSE(mask.at(x, y)) << x << " " << y;
        } else if (glm::length(nearest - centre) > inscribed) {
          EXPECT_TRUE(mask.at(x, y)) << x << " " << y;
        }
        EXPECT_TRUE(!mask.at(x, y) || glm::length(farthest) > radius);
      }
    }
    EXPECT_GT(seen_by_need, 300);
  }
}

// Random triangles against points: no point of a hidden pixel may lie outside all of them, but for the part of a pixel
// that counts as none.
TEST(HiddenArea, RandomTrianglesNeverHideAPointOutsideThem) {
  constexpr unsigned kSeed = 31;
  SCOPED_TRACE(kSeed);
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> any(-1.5, 1.5), part(0.0, 1.0);
  int hidden = 0;
  for (int round = 0; round < 40; ++round) {
    HiddenArea area;
    for (int i = 0; i < 12; ++i) {
      area.triangles.push_back({glm::dvec2(any(random), any(random)), glm::dvec2(any(random), any(random)),
                                glm::dvec2(any(random), any(random))});
    }
    const PixelMask mask = tracking::hidden_pixels(area, kLopsided, 16, 12);
    for (int i = 0; i < 200; ++i) {
      const glm::dvec2 at(16.0 * part(random), 12.0 * part(random));
      const glm::dvec2 p(-1.4 + at.x * 1.7 / 16.0, 1.1 - at.y * 1.6 / 12.0);
      const auto inside = [&](const tracking::TangentTriangle& t) {
        bool left = true, right = true;
        for (std::size_t k = 0; k < 3; ++k) {
          const glm::dvec2 side = t[(k + 1) % 3] - t[k], to = p - t[k];
          const double turn = side.x * to.y - side.y * to.x;
          left = left && turn >= 0.0;
          right = right && turn <= 0.0;
        }
        return left || right;
      };
      const bool is_hidden = mask.at(std::min(static_cast<int>(at.x), 15), std::min(static_cast<int>(at.y), 11));
      hidden += is_hidden ? 1 : 0;
      EXPECT_TRUE(!is_hidden || std::ranges::any_of(area.triangles, inside)) << round << " " << i;
    }
  }
  EXPECT_GT(hidden, 500) << "the test says nothing";
}

TEST(HiddenArea, OutsideTheFieldNothingIsSeen) {
  const FieldOfView wider{1.4 + 0.17, 0.3 + 0.17, 0.5 + 0.16,
                          1.1 + 0.16};  // two pixels more of 0.085 x 0.08 on each side
  const PixelMask mask = tracking::hidden_pixels(tracking::with_outside({}, kLopsided), wider, 24, 24);
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 24; ++x) {
      EXPECT_EQ(mask.at(x, y), x < 2 || y < 2 || x >= 22 || y >= 22) << x << " " << y;
    }
  }
}

TEST(HiddenArea, ShrinkingKeepsABandAroundAllThatIsSeen) {
  std::mt19937 random(9);
  PixelMask mask{40, 30, std::vector<std::uint8_t>(1200, 1)};
  std::vector<std::array<int, 2>> seen;
  for (int i = 0; i < 6; ++i) {
    seen.push_back({static_cast<int>(random() % 40), static_cast<int>(random() % 30)});
    mask.hidden[static_cast<std::size_t>(seen.back()[1] * 40 + seen.back()[0])] = 0;
  }
  for (const int band : {0, 1, 4, 100}) {
    const PixelMask left = tracking::shrunk(mask, band);
    for (int y = 0; y < 30; ++y) {
      for (int x = 0; x < 40; ++x) {
        const bool near = std::ranges::any_of(
            seen, [&](const auto& p) { return std::max(std::abs(p[0] - x), std::abs(p[1] - y)) <= band; });
        EXPECT_EQ(left.at(x, y), !near) << band << ": " << x << " " << y;
      }
    }
  }
}

}  // namespace
