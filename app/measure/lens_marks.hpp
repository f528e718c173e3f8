// What of a lens is drawn over its maps, and where: reference points, the frame's outline, the edges of segments.
#pragma once

#include <functional>
#include <vector>

#include "app/report/map_picture.hpp"
#include "lenses/lens.hpp"
#include "lenses/measure/lensmeter.hpp"

namespace app {

// From a point of the back (reference points, outline) and of the front (segments) to its place in the plot.
struct ToPlot {
  std::function<glm::dvec2(const glm::dvec2&)> from_back, from_front;
};

// A polygon of the lens; its straight edges may be curves in the plot.
[[nodiscard]] std::vector<glm::dvec2> plotted(const std::vector<glm::dvec2>& polygon,
                                              const std::function<glm::dvec2(const glm::dvec2&)>& to_plot);

void add_lens_marks(MapPicture& map, const lenses::Lens& lens, const ToPlot& to_plot);

// The lens as it would be without segments: rays to a segment's very edge pass it.
[[nodiscard]] lenses::Lens without_segments(lenses::Lens lens);

// Where a lensmeter's beam that meets the front at a point meets the back.
[[nodiscard]] glm::dvec2 back_of_front_point(const lenses::Lensmeter& lensmeter, const glm::dvec2& point);

}  // namespace app
