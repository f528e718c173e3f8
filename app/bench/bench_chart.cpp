#include "app/bench/bench_chart.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <sstream>

#include "app/bench/bench_text.hpp"

namespace app {
namespace {

constexpr render::Rgb kOurs{52, 101, 164}, kPaper{153, 153, 153}, kInk{0, 0, 0}, kGround{255, 255, 255};

std::string two_decimals(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", value);
  return text;
}

std::string hex(const render::Rgb& colour) {
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", colour.r, colour.g, colour.b);
  return text;
}

// A file's own name, and of a long one the end.
std::string short_name(const std::string& lens) {
  constexpr std::size_t kMost = 18;
  const bool is_file = lens.ends_with(".json");
  const std::string name = is_file ? std::filesystem::path(lens).stem().string() : lens;
  return name.size() <= kMost ? name : ".." + name.substr(name.size() - kMost + 2);
}

}  // namespace

Chart bench_chart(const BenchReport& report) {
  const int size = std::ranges::max_element(report.rows, {}, &BenchRow::size)->size;
  const std::string shading = report.rows.front().shading;
  std::vector<const BenchRow*> rows;
  double longest = 0.0;
  for (const BenchRow& row : report.rows) {
    if (row.size == size && row.shading == shading) {
      rows.push_back(&row);
      longest = std::max({longest, row.ms.max, paper_ms(row)});
    }
  }
  constexpr int kLeft = 170, kBars = 560, kStep = 34, kTop = 50;
  Chart chart{kLeft + kBars + 90, kTop + kStep * static_cast<int>(rows.size()) + 10, {}, {}};
  const std::string side = std::to_string(size);
  chart.labels.push_back(
      {10, 8, "Milliseconds a frame, " + side + "x" + side + ", " + shading + "; line: least to most", kInk});
  chart.labels.push_back({10, 28, "this device", kOurs});
  chart.labels.push_back({110, 28, "the paper's GTX 480", kPaper});
  int y = kTop;
  for (const BenchRow* row : rows) {
    const auto length = [&](double ms) { return static_cast<int>(std::lround(kBars * ms / std::max(longest, 1e-9))); };
    chart.labels.push_back({10, y + 3, short_name(row->lens) + " " + row->mode, kInk});
    chart.bars.push_back({{kLeft, y, length(row->ms.median), 12}, kOurs});
    chart.bars.push_back({{kLeft + length(row->ms.min), y + 5, length(row->ms.max) - length(row->ms.min), 2}, kInk});
    chart.labels.push_back({kLeft + length(row->ms.max) + 6, y + 2, two_decimals(row->ms.median), kInk});
    if (const double paper = paper_ms(*row); paper > 0.0) {
      chart.bars.push_back({{kLeft, y + 14, length(paper), 8}, kPaper});
      chart.labels.push_back({kLeft + length(paper) + 6, y + 14, two_decimals(paper), kPaper});
    }
    y += kStep;
  }
  return chart;
}

std::string to_svg(const Chart& chart) {
  std::ostringstream out;
  out << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << chart.width << "\" height=\"" << chart.height
      << "\" font-family=\"sans-serif\" font-size=\"12\">\n"
      << "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
  for (const Chart::Bar& bar : chart.bars) {
    out << "<rect x=\"" << bar.place.x << "\" y=\"" << bar.place.y << "\" width=\"" << bar.place.width << "\" height=\""
        << bar.place.height << "\" fill=\"" << hex(bar.colour) << "\"/>\n";
  }
  constexpr int kBaseline = 9;  // from the top of a 12 px letter
  for (const Chart::Label& label : chart.labels) {
    out << "<text x=\"" << label.x << "\" y=\"" << label.y + kBaseline << "\" fill=\"" << hex(label.colour) << "\">"
        << html_escaped(label.text) << "</text>\n";
  }
  out << "</svg>\n";
  return out.str();
}

render::Image8 to_image(const Chart& chart) {
  render::Image8 image = render::black_image(chart.width, chart.height);
  render::fill_rect(image, {0, 0, chart.width, chart.height}, kGround);
  for (const Chart::Bar& bar : chart.bars) {
    render::fill_rect(image, bar.place, bar.colour);
  }
  for (const Chart::Label& label : chart.labels) {
    render::draw_text(image, label.x, label.y, 1, label.text, label.colour);
  }
  return image;
}

}  // namespace app
