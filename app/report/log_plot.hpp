// Named points over two logarithmic axes, some of them joined, with labels that do not cover each other.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/report/drawing.hpp"

namespace app {

struct LogPlot {
  struct Point {
    double x = 0.0, x_low = 0.0, x_high = 0.0;  // above 0; the low and the high end of a bar
    double y = 0.0;                             // 0: has none, and is marked on the x axis
    std::string label = {};
    render::Rgb colour = {};
    bool marked = false;  // with a ring
  };
  // Another scale of the same y on the right: its value for a y, and the step of its ticks.
  struct OtherScale {
    std::string label;
    std::function<double(double value)> y_of;
    double step = 5.0;
    double low = 0.0, high = 0.0;  // ticks between them
  };
  struct Legend {
    std::string name;
    render::Rgb colour;
  };

  std::string title, note, x_label, y_label;
  std::vector<Point> points;
  std::vector<std::size_t> joined;  // points, in the order of the line
  std::vector<Legend> legend;
  std::vector<OtherScale> other;  // none or one
  int height = 560;               // of the plot itself, px
};

// One under the other. A plot without a point that has a y is left out.
[[nodiscard]] Drawing draw_log_plots(const std::vector<LogPlot>& plots);

// 1, 2 and 5 times powers of ten from low to high, and only the powers themselves where there would be more than
// `at_most`.
[[nodiscard]] std::vector<double> log_ticks(double low, double high, std::size_t at_most);

}  // namespace app
