#include "app/report/log_plot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "app/report/text.hpp"

namespace app {
namespace {

using render::Rect;
using render::Rgb;
using DrawnPoint = render::Point;

constexpr Rgb kInk{20, 20, 20}, kPale{222, 222, 222}, kGrey{120, 120, 120}, kJoin{70, 70, 70};
constexpr int kWidth = 1300, kLeft = 110, kRight = 96, kLine = 24;

// Whether a segment passes through a box.
bool crosses(DrawnPoint a, DrawnPoint b, const Rect& box) {
  constexpr int kSteps = 64;  // a box is wider than a 64th of a plot
  for (int i = 0; i <= kSteps; ++i) {
    const double t = static_cast<double>(i) / kSteps;
    const double x = a.x + t * (b.x - a.x), y = a.y + t * (b.y - a.y);
    if (x >= box.x && x <= box.x + box.width && y >= box.y && y <= box.y + box.height) {
      return true;
    }
  }
  return false;
}

bool overlap(const Rect& a, const Rect& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

// Short: 0.002, 1.5, 200, 1e-7.
std::string tick_text(double value) {
  return format(value < 1e-3 || value >= 1e5 ? "%.0e" : "%.6g", value);
}

class PlotDrawing {
 public:
  PlotDrawing(const LogPlot& plot, Drawing& out, int top) : plot_(plot), out_(out) {
    top_ = top + 2 * kLine + 14 + legend_lines() * kLine;
    set_ranges();
  }

  // Where the next may begin.
  int draw(int top) {
    words(top);
    axes();
    bars_and_line();
    labels();
    return top_ + plot_.height + 3 * kLine + 16;
  }

 private:
  [[nodiscard]] int plot_width() const { return kWidth - kLeft - kRight; }
  [[nodiscard]] double x_at(double x) const {
    return kLeft + plot_width() * (std::log(x) - x_low_) / (x_high_ - x_low_);
  }
  [[nodiscard]] double y_at(double y) const {
    return top_ + plot_.height * (y_high_ - std::log(y)) / (y_high_ - y_low_);
  }
  // A point without a y stands on the axis.
  [[nodiscard]] DrawnPoint place(const LogPlot::Point& p) const {
    return {x_at(p.x), p.y > 0.0 ? y_at(p.y) : static_cast<double>(top_ + plot_.height - 7)};
  }

  void set_ranges() {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    double x0 = kInfinity, x1 = 0.0, y0 = kInfinity, y1 = 0.0;
    for (const LogPlot::Point& p : plot_.points) {
      x0 = std::min({x0, p.x, p.x_low});
      x1 = std::max({x1, p.x, p.x_high});
      if (p.y > 0.0) {
        y0 = std::min(y0, p.y);
        y1 = std::max(y1, p.y);
      }
    }
    // Room for labels beside the outermost points, and at least a factor of two each way.
    const auto widened = [](double low, double high, double share) {
      const double span = std::max(std::log(high / low), std::numbers::ln2);
      const double middle = 0.5 * (std::log(low) + std::log(high));
      return std::pair{middle - (0.5 + share) * span, middle + (0.5 + share) * span};
    };
    std::tie(x_low_, x_high_) = widened(x0, x1, 0.07);
    std::tie(y_low_, y_high_) = widened(y0, y1, 0.09);
  }

  [[nodiscard]] static int legend_width(const LogPlot::Legend& entry) { return drawn_width(entry.name) + 44; }
  [[nodiscard]] int legend_lines() const {
    int lines = plot_.legend.empty() ? 0 : 1, x = 0;
    for (const LogPlot::Legend& entry : plot_.legend) {
      if (x > 0 && x + legend_width(entry) > plot_width()) {
        x = 0;
        ++lines;
      }
      x += legend_width(entry);
    }
    return lines;
  }

  void words(int top) {
    out_.texts.push_back({kLeft, top + 8, plot_.title, kInk});
    out_.texts.push_back({kLeft, top + 8 + kLine, plot_.note, kGrey});
    int x = 0, y = top + 8 + 2 * kLine;
    for (const LogPlot::Legend& entry : plot_.legend) {
      if (x > 0 && x + legend_width(entry) > plot_width()) {
        x = 0;
        y += kLine;
      }
      out_.dots.push_back({{kLeft + x + 8.0, y + 7.0}, 6.0, entry.colour});
      out_.texts.push_back({kLeft + x + 22, y, entry.name, kInk});
      x += legend_width(entry);
    }
    const int foot = top_ + plot_.height;
    out_.texts.push_back({kLeft + plot_width() / 2, foot + 10 + kLine, plot_.x_label, kInk, Drawing::Anchor::middle});
    out_.texts.push_back({kLeft + 8, top_ + 8, plot_.y_label, kInk});
    taken_.push_back({kLeft, top_, drawn_width(plot_.y_label) + 20, 30});
    for (const LogPlot::OtherScale& other : plot_.other) {
      out_.texts.push_back({kWidth - kRight - 8, top_ + 8, other.label, kInk, Drawing::Anchor::right});
      const int width = drawn_width(other.label) + 20;
      taken_.push_back({kWidth - kRight - width, top_, width, 30});
    }
  }

  void axes() {
    const double left = kLeft, right = kWidth - kRight, foot = top_ + plot_.height;
    for (const double x : log_ticks(std::exp(x_low_), std::exp(x_high_), 12)) {
      out_.lines.push_back({{x_at(x), static_cast<double>(top_)}, {x_at(x), foot}, 1.0, kPale});
      out_.texts.push_back(
          {static_cast<int>(x_at(x)), top_ + plot_.height + 8, tick_text(x), kInk, Drawing::Anchor::middle});
    }
    for (const double y : log_ticks(std::exp(y_low_), std::exp(y_high_), 10)) {
      out_.lines.push_back({{left, y_at(y)}, {right, y_at(y)}, 1.0, kPale});
      out_.texts.push_back({kLeft - 10, static_cast<int>(y_at(y)) - 7, tick_text(y), kInk, Drawing::Anchor::right});
    }
    for (const LogPlot::OtherScale& other : plot_.other) {
      for (double value = std::ceil(other.low / other.step) * other.step; value <= other.high; value += other.step) {
        const double y = other.y_of(value);
        if (std::log(y) > y_low_ && std::log(y) < y_high_) {
          out_.lines.push_back({{right, y_at(y)}, {right + 7, y_at(y)}, 1.0, kInk});
          out_.texts.push_back({kWidth - kRight + 12, static_cast<int>(y_at(y)) - 7, tick_text(value), kInk});
        }
      }
    }
    const double top = top_;
    for (const auto& [a, b] : {std::pair{DrawnPoint{left, foot}, DrawnPoint{right, foot}},
                               {DrawnPoint{left, top}, DrawnPoint{left, foot}},
                               {DrawnPoint{right, top}, DrawnPoint{right, foot}}}) {
      out_.lines.push_back({a, b, 1.5, kInk});
    }
  }

  void bars_and_line() {
    for (std::size_t i = 0; i + 1 < plot_.joined.size(); ++i) {
      line_.emplace_back(place(plot_.points[plot_.joined[i]]), place(plot_.points[plot_.joined[i + 1]]));
      out_.lines.push_back({line_.back().first, line_.back().second, 2.5, kJoin});
    }
    for (const LogPlot::Point& p : plot_.points) {
      const DrawnPoint at = place(p);
      bars_.emplace_back(DrawnPoint{x_at(p.x_low), at.y}, DrawnPoint{x_at(p.x_high), at.y});
      out_.lines.push_back({bars_.back().first, bars_.back().second, 1.5, p.colour});
      out_.dots.push_back({at, 6.0, p.colour});
      if (p.marked) {
        out_.dots.push_back({at, 11.0, kInk, true});
      }
      const int reach = p.marked ? 13 : 8;
      taken_.push_back({static_cast<int>(at.x) - reach, static_cast<int>(at.y) - reach, 2 * reach, 2 * reach});
    }
  }

  // Marked points choose first, then those of the line, then the rest.
  void labels() {
    std::vector<std::size_t> order;
    const auto add = [&](std::size_t i) {
      if (std::ranges::find(order, i) == order.end()) {
        order.push_back(i);
      }
    };
    for (std::size_t i = 0; i < plot_.points.size(); ++i) {
      if (plot_.points[i].marked) {
        add(i);
      }
    }
    std::ranges::for_each(plot_.joined, add);
    for (std::size_t i = 0; i < plot_.points.size(); ++i) {
      add(i);
    }
    for (const std::size_t i : order) {
      label(plot_.points[i]);
    }
  }

  struct Candidate {
    Rect box;
    Drawing::Anchor anchor;
    double cost;
  };

  [[nodiscard]] std::optional<Candidate> candidate(const LogPlot::Point& p, double distance, double angle) const {
    const DrawnPoint at = place(p);
    const double dx = distance * std::cos(angle), dy = -distance * std::sin(angle);
    const int width = drawn_width(p.label);
    const bool beside = std::abs(dx) > 0.35 * distance;
    Candidate c;
    c.anchor = !beside ? Drawing::Anchor::middle : dx > 0.0 ? Drawing::Anchor::left : Drawing::Anchor::right;
    const double x = at.x + dx -
                     (c.anchor == Drawing::Anchor::left    ? 0.0
                      : c.anchor == Drawing::Anchor::right ? width
                                                           : 0.5 * width);
    const double y = at.y + dy - 0.5 * kDrawnTextHeight;
    c.box = {static_cast<int>(x) - 3, static_cast<int>(y) - 3, width + 6, kDrawnTextHeight + 6};
    const bool inside = c.box.x >= kLeft && c.box.x + c.box.width <= kWidth - kRight && c.box.y >= top_ &&
                        c.box.y + c.box.height <= top_ + plot_.height;
    if (!inside || std::ranges::any_of(taken_, [&](const Rect& r) { return overlap(r, c.box); })) {
      return std::nullopt;
    }
    c.cost = distance;
    constexpr double kUnderTheLine = 60.0, kUnderALeader = 40.0, kOverAnother = 50.0,
                     kUnderABar = 30.0;  // px of distance
    const auto through = [&](const auto& segment) { return crosses(segment.first, segment.second, c.box); };
    c.cost += std::ranges::any_of(line_, through) ? kUnderTheLine : 0.0;
    c.cost += std::ranges::any_of(bars_, through) ? kUnderABar : 0.0;
    c.cost += std::ranges::any_of(leaders_, through) ? kUnderALeader : 0.0;
    const DrawnPoint end = leader_end(c.box, at);
    const Rect own{static_cast<int>(at.x) - 14, static_cast<int>(at.y) - 14, 28, 28};
    for (const Rect& other : taken_) {
      c.cost += !overlap(other, own) && crosses(at, end, other) ? kOverAnother : 0.0;
    }
    return c;
  }

  [[nodiscard]] static DrawnPoint leader_end(const Rect& box, DrawnPoint at) {
    return {std::clamp(at.x, static_cast<double>(box.x), static_cast<double>(box.x + box.width)),
            std::clamp(at.y, static_cast<double>(box.y), static_cast<double>(box.y + box.height))};
  }

  // A point in a crowd with no free place around stays without; a table has it.
  void label(const LogPlot::Point& p) {
    std::optional<Candidate> best;
    constexpr int kDirections = 24;
    for (const double distance : {16.0, 22.0, 30.0, 42.0, 56.0, 74.0, 96.0, 122.0, 152.0, 188.0}) {
      for (int i = 0; i < kDirections; ++i) {
        const auto c = candidate(p, distance, 2.0 * std::numbers::pi * i / kDirections);
        if (c && (!best || c->cost < best->cost)) {
          best = c;
        }
      }
    }
    if (!best) {
      return;
    }
    taken_.push_back(best->box);
    const DrawnPoint at = place(p), end = leader_end(best->box, at);
    constexpr double kLeaderFrom = 24.0;
    if (std::hypot(end.x - at.x, end.y - at.y) > kLeaderFrom) {
      out_.lines.push_back({at, end, 1.0, p.colour});
      leaders_.emplace_back(at, end);
    }
    const int x = best->anchor == Drawing::Anchor::left    ? best->box.x + 3
                  : best->anchor == Drawing::Anchor::right ? best->box.x + best->box.width - 3
                                                           : best->box.x + best->box.width / 2;
    out_.texts.push_back({x, best->box.y + 3, p.label, kInk, best->anchor});
  }

  const LogPlot& plot_;
  Drawing& out_;
  int top_ = 0;
  double x_low_ = 0.0, x_high_ = 1.0, y_low_ = 0.0, y_high_ = 1.0;  // logarithms
  std::vector<Rect> taken_;
  std::vector<std::pair<DrawnPoint, DrawnPoint>> line_, leaders_, bars_;
};

}  // namespace

std::vector<double> log_ticks(double low, double high, std::size_t at_most) {
  std::vector<double> all, powers;
  for (int decade = static_cast<int>(std::floor(std::log10(low))); decade <= std::log10(high); ++decade) {
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double value = factor * std::pow(10.0, decade);
      if (value >= low && value <= high) {
        all.push_back(value);
        if (factor == 1.0) {
          powers.push_back(value);
        }
      }
    }
  }
  return all.size() > at_most && powers.size() > 1 ? powers : all;
}

Drawing draw_log_plots(const std::vector<LogPlot>& plots) {
  Drawing drawing{.width = kWidth, .height = 0};
  int top = 0;
  for (const LogPlot& plot : plots) {
    if (std::ranges::any_of(plot.points, [](const LogPlot::Point& p) { return p.y > 0.0; })) {
      top = PlotDrawing(plot, drawing, top).draw(top);
    }
  }
  drawing.height = std::max(top, 1);
  return drawing;
}

}  // namespace app
