#include "render/lens_forms/iteration_histogram.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

#include "render/lens_forms/view_direction.hpp"

namespace render {
namespace {

namespace f32 = lenses::f32;
namespace f64 = lenses::f64;

void count(IterationHistogram& histogram, const f64::SurfaceData& surface, int steps) {
  if (steps >= 0) {
    ++histogram.surfaces[std::min(static_cast<std::size_t>(steps), IterationHistogram::kMost)];
  } else if (surface.kind.x == f64::kPlane || surface.kind.x == f64::kSphere) {
    ++histogram.closed_form;
  } else {
    ++histogram.searched;
  }
}

// The steps that each of the engines takes, by the same text compiled twice.
template <class Trace>
IterationHistogram of_view(const ViewSetup& view, const f64::LensData& lens, int width, int height, Trace&& trace) {
  IterationHistogram histogram;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const glm::dvec3 direction = view_direction(view, {(x + 0.5) / width, (y + 0.5) / height});
      const glm::dmat3 turn = f64::eye_turn(static_cast<int>(view.viewing), glm::normalize(view.view.gaze), direction);
      const auto path = trace(turn, direction);
      if (path.status == f64::kStatusOk) {
        count(histogram, lens.back, path.steps_back);
        count(histogram, lens.front, path.steps_front);
      }
    }
  }
  return histogram;
}

}  // namespace

std::size_t IterationHistogram::iterated() const {
  return std::accumulate(surfaces.begin(), surfaces.end(), searched);
}

double IterationHistogram::settled_within(std::size_t steps) const {
  const std::size_t all = iterated();
  const auto end = surfaces.begin() + static_cast<std::ptrdiff_t>(std::min(steps, kMost) + 1);
  return all == 0
             ? 1.0
             : static_cast<double>(std::accumulate(surfaces.begin(), end, std::size_t{0})) / static_cast<double>(all);
}

IterationHistogram& IterationHistogram::operator+=(const IterationHistogram& other) {
  std::ranges::transform(surfaces, other.surfaces, surfaces.begin(), std::plus{});
  searched += other.searched;
  closed_form += other.closed_form;
  return *this;
}

IterationHistogram iteration_histogram(const ViewSetup& view, const lenses::LensModel& lenses, int width, int height,
                                       Precision precision) {
  const f64::LensData& lens = lenses.lens[view.lens];
  if (lens.glass.w == 0.0) {
    return {};
  }
  if (precision == Precision::twofold) {
    const f64::Table table{lenses.table};
    return of_view(view, lens, width, height, [&](const glm::dmat3& turn, const glm::dvec3& direction) {
      return f64::trace_sight_line(table, lens, view.eye, turn, direction, glm::dvec2(0.0), glm::dvec2(0.0)).path;
    });
  }
  const std::vector<glm::vec4> entries = lenses::to_float(lenses.table);
  const f32::Table table{entries};
  const f32::LensData rounded = lenses::to_float(lens);
  const f32::EyeData eye = lenses::to_float(view.eye);
  return of_view(view, lens, width, height, [&](const glm::dmat3& turn, const glm::dvec3& direction) {
    return f32::trace_sight_line(table, rounded, eye, glm::mat3(turn), glm::normalize(glm::vec3(direction)),
                                 glm::vec2(0.0F), glm::vec2(0.0F))
        .path;
  });
}

}  // namespace render
