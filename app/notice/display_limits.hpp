// What a headset's display cannot show, in sentences for the person who looks into it.
#pragma once

#include <vector>

#include "app/notice/plate.hpp"
#include "lenses/headset.hpp"

namespace app {

struct DisplayLimits {
  lenses::HeadsetDisplay headset;
  double pixels_per_degree = 22.0;  // what is seen at the centre: the lesser of the display's and the picture's
  double pupil_diameter = 0.004;    // m, the wearer's as simulated
  double sunlit_pupil = 0.0025;     // m, what the wearer's would be before a sunlit page
  bool viewer_known = true;         // the wearer file tells of the viewer's own eyes
};

// Pixels of 1/px rad: of an image of so many pixels across a field, at the field's axis.
[[nodiscard]] double pixels_per_degree(int pixels, double tan_one_side, double tan_other_side);

// The letter whose strokes are one pixel wide. Minimum angle of resolution, arcmin; 20/x and logMAR follow from it.
[[nodiscard]] double finest_stroke_arcmin(double pixels_per_degree);

// A heading and a line for each limit.
[[nodiscard]] std::vector<PlateLine> limit_lines(const DisplayLimits& limits);

}  // namespace app
