// A chart as rectangles and words, and the two ways to write it.
#pragma once

#include <string>
#include <vector>

#include "app/bench/bench_report.hpp"
#include "render/image/draw.hpp"

namespace app {

struct Chart {
  struct Bar {
    render::Rect place;
    render::Rgb colour;
  };
  struct Label {
    int x, y;  // top left corner
    std::string text;
    render::Rgb colour;
  };
  int width = 0, height = 0;
  std::vector<Bar> bars;
  std::vector<Label> labels;
};

// Milliseconds of the largest size's rows, bare ones if there are any, with the paper's under each. At least one row.
[[nodiscard]] Chart bench_chart(const BenchReport& report);

[[nodiscard]] std::string to_svg(const Chart& chart);
[[nodiscard]] render::Image8 to_image(const Chart& chart);

}  // namespace app
