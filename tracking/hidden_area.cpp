#include "tracking/hidden_area.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace tracking {
namespace {

// Of a pixel, that may stay uncovered in a hidden one: corners come as floats, 1e-7 of a tangent, of which a picture
// has some thousand pixels, and triangles side by side need not share them.
constexpr double kUncoveredPart = 1e-4;

using Polygon = std::vector<glm::dvec2>;

// Twice the signed area.
double cross(const glm::dvec2& a, const glm::dvec2& b) {
  return a.x * b.y - a.y * b.x;
}

double area_of(const std::vector<Polygon>& pieces) {
  double sum = 0.0;
  for (const Polygon& piece : pieces) {
    double twice = 0.0;
    for (std::size_t i = 0; i < piece.size(); ++i) {
      twice += cross(piece[i], piece[(i + 1) % piece.size()]);
    }
    sum += 0.5 * std::abs(twice);
  }
  return sum;
}

// Counter-clockwise.
TangentTriangle turned(const TangentTriangle& t) {
  return cross(t[1] - t[0], t[2] - t[0]) < 0.0 ? TangentTriangle{t[0], t[2], t[1]} : t;
}

Polygon square(int x, int y) {
  return {{x, y}, {x + 1.0, y}, {x + 1.0, y + 1.0}, {x, y + 1.0}};
}

enum class Cover { none, part, all };

// Of a pixel by a triangle that runs counter-clockwise. Part may turn out to be nothing.
Cover cover_of(const TangentTriangle& t, int x, int y) {
  Cover cover = Cover::all;
  for (std::size_t side = 0; side < 3; ++side) {
    const glm::dvec2 along = t[(side + 1) % 3] - t[side];
    const double corner = cross(along, glm::dvec2(x, y) - t[side]);
    const double least = corner + std::min(-along.y, 0.0) + std::min(along.x, 0.0);
    const double most = corner + std::max(-along.y, 0.0) + std::max(along.x, 0.0);
    if (most <= 0.0) {
      return Cover::none;
    }
    cover = least < 0.0 ? Cover::part : cover;
  }
  return cover;
}

// A convex polygon's parts on the left and on the right of a line.
struct Halves {
  Polygon left, right;
};

Halves split(const Polygon& polygon, const glm::dvec2& from, const glm::dvec2& to) {
  Halves halves;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2& a = polygon[i];
    const glm::dvec2& b = polygon[(i + 1) % polygon.size()];
    const double at_a = cross(to - from, a - from), at_b = cross(to - from, b - from);
    if (at_a >= 0.0) {
      halves.left.push_back(a);
    }
    if (at_a <= 0.0) {
      halves.right.push_back(a);
    }
    if ((at_a > 0.0 && at_b < 0.0) || (at_a < 0.0 && at_b > 0.0)) {
      const glm::dvec2 between = a + at_a / (at_a - at_b) * (b - a);
      halves.left.push_back(between);
      halves.right.push_back(between);
    }
  }
  return halves;
}

// What a triangle leaves of convex pieces, as convex pieces.
std::vector<Polygon> without(const std::vector<Polygon>& pieces, const TangentTriangle& triangle) {
  std::vector<Polygon> left;
  for (const Polygon& piece : pieces) {
    Polygon inside = piece;
    for (std::size_t side = 0; side < 3 && !inside.empty(); ++side) {
      Halves halves = split(inside, triangle[side], triangle[(side + 1) % 3]);
      if (halves.right.size() >= 3) {
        left.push_back(std::move(halves.right));
      }
      inside = std::move(halves.left);
    }
  }
  return left;
}

// Pixels of a picture as squares of side 1, x to the right and y down, from its upper left corner.
TangentTriangle in_pixels(const TangentTriangle& triangle, const FieldOfView& fov, int width, int height) {
  TangentTriangle scaled;
  for (std::size_t i = 0; i < 3; ++i) {
    scaled[i] = {(triangle[i].x + fov.tan_left) * width / (fov.tan_left + fov.tan_right),
                 (fov.tan_up - triangle[i].y) * height / (fov.tan_down + fov.tan_up)};
  }
  return turned(scaled);
}

// First and last pixel of a row or column that a triangle may touch.
std::array<int, 2> touched(const std::array<double, 3>& corners, int count) {
  const auto whole = [&](double x) { return static_cast<int>(std::clamp(std::floor(x), -1.0, double(count))); };
  const auto [low, high] = std::ranges::minmax(corners);
  return {std::max(whole(low), 0), std::min(whole(high), count - 1)};
}

// Along a row or column: what lies within `pixels` of something seen counts as seen.
void widen_seen(std::vector<std::uint8_t>& hidden, std::size_t first, std::size_t step, std::size_t count, int pixels) {
  constexpr std::uint8_t kKept = 2;
  for (const bool forward : {true, false}) {
    int since = pixels + 1;  // something was seen
    for (std::size_t i = 0; i < count; ++i) {
      std::uint8_t& at = hidden[first + step * (forward ? i : count - 1 - i)];
      since = at == 0 ? 0 : std::min(since, pixels) + 1;
      at = since <= pixels && at != 0 ? kKept : at;
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    std::uint8_t& at = hidden[first + step * i];
    at = at == kKept ? 0 : at;
  }
}

}  // namespace

double PixelMask::hidden_fraction() const {
  const auto count = std::accumulate(hidden.begin(), hidden.end(), std::size_t{0});
  return hidden.empty() ? 0.0 : static_cast<double>(count) / static_cast<double>(hidden.size());
}

HiddenArea with_outside(HiddenArea area, const FieldOfView& fov) {
  constexpr double kFar = 1e3;  // a tangent beyond every picture's
  const auto add = [&](double left, double right, double down, double up) {
    area.triangles.push_back({{{left, down}, {right, down}, {right, up}}});
    area.triangles.push_back({{{left, down}, {right, up}, {left, up}}});
  };
  add(-kFar, -fov.tan_left, -kFar, kFar);
  add(fov.tan_right, kFar, -kFar, kFar);
  add(-kFar, kFar, -kFar, -fov.tan_down);
  add(-kFar, kFar, fov.tan_up, kFar);
  return area;
}

PixelMask hidden_pixels(const HiddenArea& area, const FieldOfView& fov, int width, int height) {
  const auto columns = static_cast<std::size_t>(width);
  PixelMask mask{width, height, std::vector<std::uint8_t>(columns * static_cast<std::size_t>(height))};
  std::map<std::size_t, std::vector<Polygon>> cut;  // what is left of pixels that no triangle hides alone
  for (const TangentTriangle& triangle : area.triangles) {
    const TangentTriangle t = in_pixels(triangle, fov, width, height);
    const auto [first_x, last_x] = touched({t[0].x, t[1].x, t[2].x}, width);
    const auto [first_y, last_y] = touched({t[0].y, t[1].y, t[2].y}, height);
    for (int y = first_y; y <= last_y; ++y) {
      for (int x = first_x; x <= last_x; ++x) {
        const std::size_t at = static_cast<std::size_t>(y) * columns + static_cast<std::size_t>(x);
        const Cover cover = mask.hidden[at] != 0 ? Cover::none : cover_of(t, x, y);
        if (cover == Cover::part) {
          std::vector<Polygon>& left = cut.try_emplace(at, 1, square(x, y)).first->second;
          left = without(left, t);
          mask.hidden[at] = area_of(left) <= kUncoveredPart ? 1 : 0;
        } else if (cover == Cover::all) {
          mask.hidden[at] = 1;
        }
      }
    }
  }
  return mask;
}

PixelMask shrunk(const PixelMask& mask, int pixels) {
  PixelMask left = mask;
  const auto width = static_cast<std::size_t>(mask.width), height = static_cast<std::size_t>(mask.height);
  for (std::size_t y = 0; y < height; ++y) {
    widen_seen(left.hidden, y * width, 1, width, pixels);
  }
  for (std::size_t x = 0; x < width; ++x) {
    widen_seen(left.hidden, x, width, height, pixels);
  }
  return left;
}

}  // namespace tracking
