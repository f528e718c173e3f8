// Where a panel of text stands before the head, so that both eyes see all of it.
#pragma once

#include <array>

#include "tracking/stereo_view.hpp"

namespace app {

struct PanelPlace {
  tracking::Pose head_from_panel;    // at its centre; +z towards the head
  double width = 0.0, height = 0.0;  // m
};

struct PanelPlaceConfig {
  double distance = 1.5;  // m
  // What it is wished to be, rad; narrower and lower where the fields of view are too small for it.
  double width = 0.4, height = 0.04;
};

// Low in the field: its centre 17.5 degrees below straight ahead, its top no higher than 8 degrees below. Where that
// leaves the middle 85 % of either eye's field of view it goes up, to straight ahead at most, and then shrinks.
// views: by Side.
[[nodiscard]] PanelPlace place_panel(const std::array<tracking::EyeView, 2>& views, const PanelPlaceConfig& config);

// Angle of the letter x, rad, from a display's resolution: 12 pixels, and no less than 0.4 degrees, at which reading
// is fluent (Legge and Bigelow 2011: from 0.2 degrees on).
[[nodiscard]] double letter_angle(double pixels_per_degree);

}  // namespace app
