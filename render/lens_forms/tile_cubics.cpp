#include "render/lens_forms/tile_cubics.hpp"

#include <algorithm>

#include "lenses/engine.hpp"

namespace render {
namespace {

// A pixel's step in slope. Tiles that span more than some 2 degrees cross the knots of a spline lens everywhere.
constexpr double kWidestPixel = 5e-3;

bool is_fine(const ViewSetup& view, int width, int height) {
  const auto& fov = view.view.fov;
  return fov.tan_left + fov.tan_right <= kWidestPixel * width && fov.tan_down + fov.tan_up <= kWidestPixel * height;
}

}  // namespace

bool may_be_cubic(const FrameConfig& config, const std::vector<ViewSetup>& views, Traversal traversal) {
  const LensAccuracy& lens = config.accuracy.lens;
  const bool is_picture = config.mode == Mode::adof || config.mode == Mode::pinhole;
  const bool is_asked = lens.cubics == TileCubics::always ||
                        (lens.cubics == TileCubics::in_pictures && is_picture && !config.keep_wavefront);
  return is_asked && lens.form == LensForm::exact && lens.spacing == 1 && !lens.in_double && lens.iterations == 0 &&
         config.mode != Mode::dof && traversal == Traversal::tile &&
         std::ranges::all_of(views, [&](const ViewSetup& v) { return is_fine(v, config.width, config.height); });
}

bool can_be_cubic(const vk::DeviceLimits& limits, std::uint32_t surface_kinds) {
  constexpr std::uint32_t kSegment = 1U << static_cast<unsigned>(lenses::f64::kSegmented);
  constexpr std::uint32_t kOutlined = kSegment | kSegment << 16U | 1U << 31U;
  return limits.on_processor && limits.subgroup_size == 8 && surface_kinds != 0 && (surface_kinds & kOutlined) == 0;
}

}  // namespace render
