// Frame traces of a job:
//   TRCFMT=1;360;E;R;F   format 1 (text); points; E equal angles, U as A records say; side; F frame
//   R=2600;2600;...      radii in 0.01 mm from the box's centre, counter-clockwise as the viewer who faces the wearer
//                        sees it, from the viewer's right; as many lines as it takes
//   A=0;100;...          angles in 0.01 degrees, for U
#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "lenses/lens_io/oma_job.hpp"

namespace lenses::io {

struct OmaTrace {
  Side side = Side::right;
  std::size_t first_line = 0, end_line = 0;  // from TRCFMT to behind the last of its records
  std::vector<glm::dvec2> outline;           // m, wearer's axes, counter-clockwise as the wearer sees it
};

[[nodiscard]] std::vector<OmaTrace> read_traces(const OmaJob& job);

// The other eye's outline.
[[nodiscard]] std::vector<glm::dvec2> mirrored(const std::vector<glm::dvec2>& outline);

// TRCFMT and R lines of 360 radii of an outline around the origin. std::invalid_argument where a ray from the origin
// does not meet the outline exactly once.
[[nodiscard]] std::vector<std::string> trace_lines(const std::vector<glm::dvec2>& outline, Side side);

}  // namespace lenses::io
