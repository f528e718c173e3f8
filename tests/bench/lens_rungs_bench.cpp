// Error and milliseconds of every rung of the lens, against the double-precision reference:
//   lens_rungs_bench [SIZE [ROUNDS]]
// A row a rung: direction (rad), power and astigmatism (D) at the median, the 99th percentile and the greatest; the
// median of rays and trace stages over interleaved rounds, and their ratio to the rung "standard" of the same rounds.
// Then the steps that Newton's method takes, and the pixels of another status.
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>

#include "render/ladder.hpp"
#include "render/lens_forms/iteration_histogram.hpp"
#include "tests/support/rung_frame.hpp"

namespace {

double median(std::vector<double> values) {
  return support::spread_of(std::move(values)).median;
}

void print_spread(const support::Spread& s) {
  std::printf(" | %.1e %.1e %.1e", s.median, s.p99, s.greatest);
}

void print_steps(const support::WornPair& pair, const render::ViewSetup& view, int size) {
  for (const bool twofold : {false, true}) {
    const auto steps = render::iteration_histogram(view, pair.model, size, size,
                                                   twofold ? render::Precision::twofold : render::Precision::single);
    std::printf("steps in %s:", twofold ? "double" : "float");
    for (std::size_t n = 0; n < steps.surfaces.size(); ++n) {
      if (steps.surfaces[n] > 0) std::printf(" %zu: %zu,", n, steps.surfaces[n]);
    }
    std::printf(" searched %zu, closed form %zu, within three %.5f\n", steps.searched, steps.closed_form,
                steps.settled_within(3));
  }
}

void bench(support::RungDevice& device, const char* name, const support::WornPair& pair, const render::ViewSetup& view,
           int size, int rounds) {
  std::printf("%s\n", name);
  const support::ReferencePicture reference(pair, view, size);
  struct Row {
    std::string_view name;
    std::unique_ptr<support::RungFrame> frame;
    std::vector<double> rays, trace;
  };
  std::vector<Row> rows;
  for (const render::Rung& rung : render::ladder()) {
    const bool is_lens = rung.subject.starts_with("lens") || rung.name == "standard";
    if (is_lens) {
      rows.push_back(
          {rung.name, std::make_unique<support::RungFrame>(device, pair, view, rung.accuracy.lens, size), {}, {}});
    }
  }
  for (int round = -1; round < rounds; ++round) {
    for (Row& row : rows) {
      for (const auto& stage : row.frame->run()) {
        if (round >= 0 && stage.name == "rays") row.rays.push_back(stage.milliseconds);
        if (round >= 0 && stage.name == "trace") row.trace.push_back(stage.milliseconds);
      }
    }
  }
  const double rays = median(rows.front().rays);
  const double both = rays + median(rows.front().trace);
  for (const Row& row : rows) {
    const auto errors = row.frame->against(reference);
    std::printf("%-18s", std::string(row.name).c_str());
    print_spread(errors.direction);
    print_spread(errors.power);
    print_spread(errors.astigmatism);
    const double own = median(row.rays);
    std::printf(" | rays %.2f ms, %.2f; with trace %.2f ms, %.2f | status %zu, inside %zu of %zu%s\n", own, own / rays,
                own + median(row.trace), (own + median(row.trace)) / both, errors.status_differs,
                errors.status_differs_inside, errors.through, errors.finite ? "" : " NOT FINITE");
  }
  print_steps(pair, view, size);
}

}  // namespace

int main(int argc, char** argv) {
  const int size = argc > 1 ? std::atoi(argv[1]) : 512;
  const int rounds = argc > 2 ? std::atoi(argv[2]) : 5;
  support::RungDevice device;
  const auto fov = tracking::FieldOfView::symmetric(60.0 * support::kDegree, 1.0);
  const auto progressive = lenses::read_lens(VERGENCE_TEST_DATA "/progressive_add200_right.json");
  const lenses::Spectacles same{"progressive_add200", {progressive, progressive}, glm::dvec3(1.0)};
  const auto spline = lenses::read_spectacles(VERGENCE_ASSETS "/spectacles/presbyopia_bspline_sphere.json");
  for (const auto& [name, spectacles] : {std::pair{"progressive_add200", same}, std::pair{"bspline/sphere", spline}}) {
    const auto pair = support::wear(lenses::Wearer{}, &spectacles, tracking::Pose{});
    bench(device, name, pair, support::view_along(pair, 0, render::Viewing::gaze, {0.0, -0.2, -1.0}, fov), size,
          rounds);
  }
}
