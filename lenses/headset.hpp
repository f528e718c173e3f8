// What the headset shows the viewer: the distance of its virtual image, its resolution and its brightness.
#pragma once

namespace lenses {

struct HeadsetDisplay {
  // Where the runtime places a view's origin inside the viewer's eye.
  enum class ViewOrigin { pupil, rotation_centre };

  double focal_distance = 1.5;      // of the virtual image, m
  double pixels_per_degree = 22.0;  // at the centre of the view
  double luminance = 100.0;         // of white, cd/m2
  ViewOrigin view_origin = ViewOrigin::pupil;
};

}  // namespace lenses
