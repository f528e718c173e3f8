#include "app/report/map_picture.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "app/report/text.hpp"
#include "lenses/measure/lens_outline.hpp"
#include "render/image/colour_bar.hpp"
#include "render/image/draw.hpp"
#include "render/image/gpu/colour_map.h"

namespace app {
namespace {

using render::Image8;
using render::Point;
using render::Rect;
using render::Rgb;

constexpr Rgb kInk{0, 0, 0}, kGround{255, 255, 255}, kNoValue{222, 222, 222}, kFrame{96, 96, 96};
constexpr int kPlot = 660, kLeft = 92, kTop = 72, kBottom = 74, kBar = 150;
constexpr int kText = 2, kTextHeight = kText * render::kTextHeight;
const Rect kPlotRect{kLeft, kTop, kPlot, kPlot};

bool overlap(const Rect& a, const Rect& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

Rgb colour_of(double value, const MapScale& scale) {
  const auto x = static_cast<float>((value - scale.low) / (scale.high - scale.low));
  const glm::vec3 c = 255.0F * render::gpu::colour_map(render::gpu::kPerceptualMap, x);
  const auto step = [](float v) { return static_cast<std::uint8_t>(std::lround(v)); };
  return {step(c.r), step(c.g), step(c.b)};
}

// Of ink on the colour of a value: the map is dark at its low end.
Rgb ink_on(double value, const MapScale& scale) {
  return value < scale.low + 0.6 * (scale.high - scale.low) ? kGround : kInk;
}

void draw_text_beside(Image8& image, int x, int y, const std::string& text, Rgb ink, Rgb halo) {
  for (const auto& [dx, dy] : {std::pair{-2, 0}, {2, 0}, {0, -2}, {0, 2}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}}) {
    render::draw_text(image, x + dx, y + dy, kText, text, halo);
  }
  render::draw_text(image, x, y, kText, text, ink);
}

class Drawing {
 public:
  explicit Drawing(const MapPicture& map)
      : map_(map), filled_(map.field), image_(render::black_image(kLeft + kPlot + kBar, kTop + kPlot + kBottom)) {
    render::fill_rect(image_, {0, 0, image_.width, image_.height}, kGround);
    const glm::dvec2 size = map.field.grid.high - map.field.grid.low;
    per_pixel_ = std::max(size.x, size.y) / kPlot;
    middle_ = 0.5 * (map.field.grid.low + map.field.grid.high);
    // A sample without a value, such as one in the wall of a segment, belongs to where it lies.
    for (std::size_t i = 0; i < filled_.zones.size(); ++i) {
      if (!std::isfinite(filled_.values[i])) {
        filled_.zones[i] = zone_at(filled_.grid.at(i));
      }
    }
    filled_ = grown(std::move(filled_), 3);
  }

  Image8 finished() {
    fill();
    draw_strokes();
    draw_isolines();
    for (const auto& outline : map_.outlines) {
      draw_polygon(outline, 3.0, kInk);
    }
    for (const MapZone& zone : map_.zones) {
      draw_polygon(zone.edge, 2.0, kInk);
    }
    draw_marks();
    draw_axes();
    draw_words();
    return std::move(image_);
  }

 private:
  [[nodiscard]] Point pixel(const glm::dvec2& p) const {
    const glm::dvec2 off = (p - middle_) / per_pixel_;
    return {kLeft + 0.5 * kPlot + (map_.mirrored ? -off.x : off.x), kTop + 0.5 * kPlot - off.y};
  }
  [[nodiscard]] glm::dvec2 place(double x, double y) const {
    const double right = x - (kLeft + 0.5 * kPlot);
    return middle_ + per_pixel_ * glm::dvec2(map_.mirrored ? -right : right, kTop + 0.5 * kPlot - y);
  }

  void fill() {
    for (int row = 0; row < kPlot; ++row) {
      const double y = kTop + row + 0.5;
      for (const auto& [from, to] : inside_region(y)) {
        const int first = std::max(kLeft, static_cast<int>(std::ceil(from - 0.5)));
        const int last = std::min(kLeft + kPlot - 1, static_cast<int>(std::floor(to - 0.5)));
        for (int x = first; x <= last; ++x) {
          fill_pixel(x, kTop + row);
        }
      }
    }
    draw_polygon(map_.region, 1.5, kFrame);
  }

  [[nodiscard]] int zone_at(const glm::dvec2& point) const {
    int zone = 0;
    for (const MapZone& part : map_.zones) {
      zone += lenses::inside_polygon(part.edge, point) ? part.number : 0;
    }
    return zone;
  }

  void fill_pixel(int x, int y) {
    const double value =
        value_at(filled_, place(x + 0.5, y + 0.5), [&](const glm::dvec2& point) { return zone_at(point); });
    render::fill_rect(image_, {x, y, 1, 1}, std::isfinite(value) ? colour_of(value, map_.scale) : kNoValue);
  }

  // The parts of a row of pixels within the region, even-odd.
  [[nodiscard]] std::vector<std::pair<double, double>> inside_region(double y) const {
    std::vector<double> crossings;
    for (std::size_t i = 0; i < map_.region.size(); ++i) {
      const Point a = pixel(map_.region[i]), b = pixel(map_.region[(i + 1) % map_.region.size()]);
      if ((a.y > y) != (b.y > y)) {
        crossings.push_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
      }
    }
    std::ranges::sort(crossings);
    std::vector<std::pair<double, double>> parts;
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
      parts.emplace_back(crossings[i], crossings[i + 1]);
    }
    return parts;
  }

  void draw_polygon(const std::vector<glm::dvec2>& polygon, double thickness, Rgb colour) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      line(polygon[i], polygon[(i + 1) % polygon.size()], thickness, colour);
    }
  }

  // Nothing leaves the plot.
  void line(const glm::dvec2& from, const glm::dvec2& to, double thickness, Rgb colour) {
    const auto within = [](const Point& p) {
      return p.x >= kLeft && p.x <= kLeft + kPlot && p.y >= kTop && p.y <= kTop + kPlot;
    };
    const Point a = pixel(from), b = pixel(to);
    if (within(a) && within(b)) {
      render::draw_line(image_, a, b, thickness, colour);
    }
  }

  void draw_strokes() {
    constexpr double kHalf = 8.0, kThick = 2.5;  // px
    for (const MapStroke& stroke : map_.strokes) {
      const glm::dvec2 along = kHalf * per_pixel_ * glm::dvec2(std::cos(stroke.angle), std::sin(stroke.angle));
      const double value = value_at(map_.field, stroke.at);
      line(stroke.at - along, stroke.at + along, kThick, ink_on(value, map_.scale));
    }
  }

  void draw_isolines() {
    struct Level {
      double value;
      std::vector<Isoline> lines;
    };
    std::vector<Level> levels;
    const int count = static_cast<int>(std::lround((map_.scale.high - map_.scale.low) / map_.scale.step));
    for (int i = 0; i <= count; ++i) {
      const double value = map_.scale.low + i * map_.scale.step;
      constexpr double kRipple = 0.08;  // of a step: 0.02 D where lines are 0.25 D apart
      levels.push_back({value, isolines(map_.field, value, kRipple * map_.scale.step)});
    }
    for (const Level& level : levels) {
      for (const Isoline& isoline : level.lines) {
        for (std::size_t i = 0; i + 1 < isoline.points.size(); ++i) {
          line(isoline.points[i], isoline.points[i + 1], 1.5, ink_on(level.value, map_.scale));
        }
      }
    }
    // Labels last, so that no line runs through one; marks are drawn over all.
    taken_.push_back({kLeft, kTop, render::text_width(map_.y_label, kText) + 14, kTextHeight + 14});
    for (const MapMark& mark : map_.marks) {
      const Point p = pixel(mark.at);
      taken_.push_back({static_cast<int>(p.x) - 12, static_cast<int>(p.y) - 20, 40, 34});
    }
    for (const Level& level : levels) {
      for (const Isoline& isoline : level.lines) {
        label_isoline(isoline, level.value);
      }
    }
  }

  // Where there is room: from the middle of the line outwards.
  void label_isoline(const Isoline& isoline, double value) {
    constexpr double kShortest = 60.0;  // px
    std::vector<double> length{0.0};
    for (std::size_t i = 0; i + 1 < isoline.points.size(); ++i) {
      length.push_back(length.back() + glm::distance(isoline.points[i], isoline.points[i + 1]) / per_pixel_);
    }
    if (length.back() < kShortest) {
      return;
    }
    const std::string text = number(value, map_.decimals);
    const int width = render::text_width(text, kText);
    for (const double part : {0.5, 0.35, 0.65, 0.2, 0.8, 0.42, 0.58, 0.28, 0.72, 0.12, 0.88}) {
      const auto at = std::ranges::lower_bound(length, part * length.back()) - length.begin();
      const Point p = pixel(isoline.points[static_cast<std::size_t>(at)]);
      const Rect box{static_cast<int>(p.x) - width / 2 - 5, static_cast<int>(p.y) - kTextHeight / 2 - 4, width + 10,
                     kTextHeight + 8};
      const bool inside =
          box.x >= kLeft && box.x + box.width <= kLeft + kPlot && box.y >= kTop && box.y + box.height <= kTop + kPlot;
      if (!inside || std::ranges::any_of(taken_, [&](const Rect& r) { return overlap(r, box); })) {
        continue;
      }
      taken_.push_back(box);
      // A line that ran into the number would look like its sign.
      for (int y = box.y + 2; y < box.y + box.height - 2; ++y) {
        for (int x = box.x; x < box.x + box.width; ++x) {
          fill_pixel(x, y);
        }
      }
      const Rgb ink = ink_on(value, map_.scale);
      draw_text_beside(image_, box.x + 5, box.y + 4, text, ink, colour_of(value, map_.scale));
      return;
    }
  }

  void draw_marks() {
    for (const MapMark& mark : map_.marks) {
      // White under black shows on every colour.
      for (const auto& [colour, thickness] : {std::pair{kGround, 5.0}, {kInk, 2.0}}) {
        draw_mark(mark, colour, thickness);
      }
      const Point p = pixel(mark.at);
      draw_text_beside(image_, static_cast<int>(p.x) + 12, static_cast<int>(p.y) - kTextHeight - 4, mark.label, kInk,
                       kGround);
    }
  }

  void draw_mark(const MapMark& mark, Rgb colour, double thickness) {
    const double size = (mark.shape == MapMark::Shape::dot ? 2.0 : 9.0) * per_pixel_;
    if (mark.shape == MapMark::Shape::cross) {
      line(mark.at - glm::dvec2(size, 0.0), mark.at + glm::dvec2(size, 0.0), thickness, colour);
      line(mark.at - glm::dvec2(0.0, size), mark.at + glm::dvec2(0.0, size), thickness, colour);
      return;
    }
    constexpr int kSides = 24;
    std::vector<glm::dvec2> circle;
    for (int i = 0; i < kSides; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kSides;
      circle.push_back(mark.at + size * glm::dvec2(std::cos(angle), std::sin(angle)));
    }
    draw_polygon(circle, thickness, colour);
  }

  void draw_axes() {
    const Rgb ink = kInk;
    render::draw_hline(image_, kLeft, kTop + kPlot, kPlot, 1, ink);
    render::draw_vline(image_, kLeft - 1, kTop, kPlot, 1, ink);
    const glm::dvec2 low = place(kLeft, kTop + kPlot), high = place(kLeft + kPlot, kTop);
    for (const render::Tick& tick : render::round_ticks(std::min(low.x, high.x), std::max(low.x, high.x), 9)) {
      const int x = static_cast<int>(std::lround(pixel({tick.value, 0.0}).x));
      render::draw_vline(image_, x, kTop + kPlot, 6, 1, ink);
      render::draw_text(image_, x - render::text_width(tick.label, kText) / 2, kTop + kPlot + 10, kText, tick.label,
                        ink);
    }
    for (const render::Tick& tick : render::round_ticks(low.y, high.y, 9)) {
      const int y = static_cast<int>(std::lround(pixel({0.0, tick.value}).y));
      render::draw_hline(image_, kLeft - 7, y, 6, 1, ink);
      render::draw_text(image_, kLeft - 12 - render::text_width(tick.label, kText), y - kTextHeight / 2, kText,
                        tick.label, ink);
    }
  }

  void draw_words() {
    const auto centred = [&](int middle, int y, const std::string& text) {
      render::draw_text(image_, middle - render::text_width(text, kText) / 2, y, kText, text, kInk);
    };
    render::draw_text(image_, kLeft, 12, kText, map_.title, kInk);
    render::draw_text(image_, kLeft, 42, kText, map_.note, kFrame);
    const int foot = kTop + kPlot + 42;
    centred(kLeft + kPlot / 2, foot, map_.x_label);
    const std::string &at_left = map_.mirrored ? map_.right : map_.left,
                      &at_right = map_.mirrored ? map_.left : map_.right;
    render::draw_text(image_, kLeft, foot, kText, at_left, kInk);
    render::draw_text(image_, kLeft + kPlot - render::text_width(at_right, kText), foot, kText, at_right, kInk);
    draw_text_beside(image_, kLeft + 8, kTop + 8, map_.y_label, kInk, kGround);
    render::draw_colour_bar(image_, {kLeft + kPlot + 14, kTop - 4, kBar - 18, kPlot + 14}, render::gpu::kPerceptualMap,
                            map_.scale.low, map_.scale.high, "", map_.unit, {kInk, kGround, 1.0, kText});
  }

  const MapPicture& map_;
  GridField filled_;
  Image8 image_;
  double per_pixel_;
  glm::dvec2 middle_;
  std::vector<Rect> taken_;  // by labels
};

}  // namespace

Image8 draw_map(const MapPicture& map) {
  return Drawing(map).finished();
}

}  // namespace app
