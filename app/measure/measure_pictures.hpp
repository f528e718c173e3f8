// The maps of a measured lens as pictures.
#pragma once

#include <string>
#include <vector>

#include "app/measure/measure_report.hpp"
#include "app/report/map_picture.hpp"
#include "lenses/measure/lens_map.hpp"
#include "lenses/measure/worn_map.hpp"

namespace app {

enum class ViewedBy { wearer, examiner };

struct NamedPicture {
  std::string file;     // its name in the report's folder
  std::string caption;  // what it shows, for a page
  render::Image8 image;
};

// Power, cylinder, prism and thickness over the lens; power and astigmatism over the turning eye's gaze, for far
// objects and at each gaze's working distance.
[[nodiscard]] std::vector<NamedPicture> measure_pictures(const MeasureReport& report, const lenses::LensMap& lens_map,
                                                         const lenses::WornMap& worn_map, const lenses::Eye& eye,
                                                         ViewedBy viewed_by);

}  // namespace app
