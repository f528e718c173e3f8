// What the stages of approximate defocus need to know of a picture.
#pragma once

#include <cstddef>
#include <vector>

#include "render/view_setup.hpp"

namespace render {

// How many tiles a picture has (gpu::kBlurTile).
[[nodiscard]] std::size_t blur_tiles(int width, int height);

// Of each view: what half the pupil spans in the picture's middle, seen from a dioptre away, px.
[[nodiscard]] std::vector<float> half_pupils_px(const std::vector<ViewSetup>& views, int width);

}  // namespace render
