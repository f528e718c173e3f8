// What one eye looks through and where it stands: the renderer's input for a view. Lens, eye and head each have their
// own pose (the paper's Figure 2), and changing one rebuilds nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "lenses/lens_model.hpp"
#include "render/frame_types.hpp"
#include "tracking/stereo_view.hpp"

namespace render {

using tracking::Viewing;

// A headset's pixels are points of its virtual image; a desktop picture has none.
struct VirtualImage {
  double distance = 1.5;             // m
  double origin_behind_pupil = 0.0;  // where the view's origin lies behind the primary-gaze pupil, m
};

struct ViewSetup {
  std::size_t lens = 0;  // index into the LensModel
  lenses::f64::EyeData eye;
  tracking::Pose world_from_eye;  // the eye's primary-gaze axes, origin: its pupil in primary gaze
  tracking::EyeView view;         // its orientation relative to those axes, its field of view, its gaze
  Viewing viewing = Viewing::gaze;
  std::optional<double> accommodation;  // D, one state for the whole picture; absent: each ray its own
  glm::dvec3 tint{1.0};
  std::optional<VirtualImage> virtual_image;
};

// Rounds to float once. A view whose numbers are not finite throws std::invalid_argument.
[[nodiscard]] gpu::ViewData make_view_data(const ViewSetup& setup, const lenses::LensModel& lenses);

// What kernels must know of these views, whatever their numbers: bit k for the way of viewing k, 8 for a lens that
// turns with the eye, 16 for a headset's virtual image.
[[nodiscard]] std::uint32_t view_traits(const std::vector<ViewSetup>& views, const lenses::LensModel& lenses);

}  // namespace render
