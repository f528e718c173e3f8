#include "app/bench/bench_report.hpp"

#include <algorithm>
#include <set>

#include "app/bench/bench_growth.hpp"
#include "app/bench/bench_text.hpp"
#include "app/report/html.hpp"

namespace app {
namespace {

const BenchRow* find(const BenchReport& report, const std::string& lens, const std::string& mode, int size,
                     const std::string& shading) {
  const auto found = std::ranges::find_if(report.rows, [&](const BenchRow& r) {
    return r.lens == lens && r.mode == mode && r.size == size && r.shading == shading;
  });
  return found == report.rows.end() ? nullptr : &*found;
}

const PeerRow* find_peer(const BenchReport& report, const std::string& lens, int size) {
  const auto found =
      std::ranges::find_if(report.peers, [&](const PeerRow& p) { return p.lens == lens && p.size == size; });
  return found == report.peers.end() ? nullptr : &*found;
}

std::set<int> sizes_of(const BenchReport& report) {
  std::set<int> sizes;
  for (const BenchRow& row : report.rows) {
    sizes.insert(row.size);
  }
  return sizes;
}

std::string stage_list(const BenchRow& row) {
  std::string text;
  for (const auto& [name, ms] : row.stages) {
    text += format("%s%s %.2f", text.empty() ? "" : ", ", name.c_str(), ms);
  }
  return text;
}

std::string rows_of_size(const BenchReport& report, int size, const std::string& shading) {
  std::string out;
  for (const BenchRow& row : report.rows) {
    if (row.size != size || row.shading != shading) {
      continue;
    }
    if (out.empty()) {
      out = format("\n%dx%d, %s\n", size, size,
                   shading == "bare" ? "bare: base colours, one light, no shadow rays, one ray a pixel, as in the paper"
                                     : "full: every light with its shadow rays, edges refined");
      out += format("%-*s mode    median ms      min      max      fps   cpu ms   GTX 480 ms   stages\n",
                    lens_width(report), "lens");
    }
    const bool compared = shading == "bare" && paper_ms(row) > 0.0;
    const std::string paper = compared ? format("%12.2f", paper_ms(row)) : format("%12s", "-");
    out += format("%-*s %-5s %11.2f %8.2f %8.2f %8.1f %8.1f %s   %s\n", lens_width(report), row.lens.c_str(),
                  row.mode.c_str(), row.ms.median, row.ms.min, row.ms.max, row.fps(), row.cpu.median, paper.c_str(),
                  stage_list(row).c_str());
  }
  return out;
}

// Of the least of all rounds.
std::string by_processor(const BenchReport& report, const Spread& over, const Spread& under) {
  return report.on_processor && under.min > 0.0 ? format(", by processor time %.2f", over.min / under.min) : "";
}

std::string ratios_of_size(const BenchReport& report, int size) {
  std::string out;
  const BenchRow* pinhole = find(report, "none", "pin", size, "bare");
  const BenchRow* plain = find(report, "none", "adof", size, "bare");
  const BenchRow* spline = find(report, "bspline/sphere", "adof", size, "bare");
  const PeerRow* plain_peer = find_peer(report, "none", size);
  const PeerRow* spline_peer = find_peer(report, "bspline/sphere", size);
  if (pinhole != nullptr && plain_peer != nullptr && pinhole->stage("trace") > 0.0) {
    // Both in millions of rays a second. These stages find hits and no more; the per-ray one shades them too.
    const double tile = pinhole->stage("tile"), query = pinhole->stage("ray_query");
    const double alone = tile > 0.0 ? tile : query;
    const double ours = pinhole->pixels() / (alone > 0.0 ? alone : pinhole->stage("trace")) * 1e-3;
    const double peer = static_cast<double>(plain_peer->rays) / plain_peer->ms.median * 1e-3;
    out += format("  scene rays: %.1f M/s (%s of none/pin), Embree16 %.1f M/s: %.2f of it\n", ours,
                  tile > 0.0    ? "tile stage"
                  : query > 0.0 ? "ray query stage"
                                : "trace stage, shading included,",
                  peer, ours / peer);
  }
  const BenchRow* fine = find(report, kFineNetLens, "adof", size, "bare");
  if (plain != nullptr && spline != nullptr && plain->ms.median > 0.0) {
    out += format("  bspline/sphere adof / none adof: %.2f%s (paper: %.2f)\n", spline->ms.median / plain->ms.median,
                  by_processor(report, spline->cpu, plain->cpu).c_str(),
                  *paper_fps("none", "adof") / *paper_fps("bspline/sphere", "adof"));
  }
  if (spline != nullptr && spline_peer != nullptr) {
    out +=
        format("  bspline/sphere adof frame %.2f ms / Embree16 on its %zu scene rays %.2f ms (%.2f to %.2f): %.2f%s\n",
               spline->ms.median, spline_peer->rays, spline_peer->ms.median, spline_peer->ms.min, spline_peer->ms.max,
               spline->ms.median / spline_peer->ms.median, by_processor(report, spline->cpu, spline_peer->cpu).c_str());
  }
  if (spline != nullptr && fine != nullptr && spline->ms.median > 0.0) {
    out += format("  100 x 100 control points / 50 x 50: frame %.3f%s, trace stage %.3f\n",
                  fine->ms.median / spline->ms.median, by_processor(report, fine->cpu, spline->cpu).c_str(),
                  fine->stage("trace") / spline->stage("trace"));
  }
  return out.empty() ? out : format("\nRatios at %dx%d\n", size, size) + out;
}

std::string machines(const BenchReport& report) {
  std::string out = format("%s: %zu triangles, one eye, %d interleaved rounds; Embree with %u threads\n",
                           report.scene.c_str(), report.triangles, report.rounds, report.peer_threads);
  out += format("%s: %.0f GFLOPS, %.1f GB/s (measured: multiply-adds, copy)\n", report.device.c_str(), report.gflops,
                report.gigabytes_per_s);
  out += format(
      "The paper's GeForce GTX 480: %.0f GFLOPS, %.1f GB/s (published); its times are of 1024x1024, scaled by pixels\n",
      kPaperGflops, kPaperGigabytes_per_s);
  return out;
}

}  // namespace

std::string bench_table(const BenchReport& report) {
  std::string out = machines(report);
  for (const int size : sizes_of(report)) {
    out += rows_of_size(report, size, "bare") + rows_of_size(report, size, "full") + ratios_of_size(report, size);
  }
  return out + growth_table(report);
}

std::string bench_page(const BenchReport& report) {
  return html_page("benchmark", "<h1>Benchmark</h1>\n<img src=\"bench.svg\" alt=\"Milliseconds a frame\">\n<pre>\n" +
                                    html_escaped(bench_table(report)) +
                                    "</pre>\n<p>Every number is in <a href=\"bench.csv\">bench.csv</a>.</p>\n");
}

}  // namespace app
