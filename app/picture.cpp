#include "app/picture.hpp"

#include "render/image/srgb.hpp"

namespace app {

PictureColumn picture_column(const PictureLayout& layout, int x) {
  const auto side = static_cast<std::size_t>(x / layout.width);
  const int column = x % layout.width;
  const int middle = layout.width / 2;
  const bool second = layout.pairs == 2 && column >= middle;
  return {(second ? layout.sides : 0) + side, column,
          layout.pairs == 2 && (column == middle || column == middle - 1) && layout.width > 8};
}

render::Image8 compose_display(const PictureLayout& layout, const render::RenderedFrame& frame) {
  constexpr std::uint8_t kDivider = 255;
  render::Image8 out = render::black_image(layout.picture_width(), layout.height);
  for (int x = 0; x < out.width; ++x) {
    const PictureColumn column = picture_column(layout, x);
    const render::Image8& view = frame.views[column.view].display;
    for (int y = 0; y < out.height; ++y) {
      const auto to =
          3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(out.width) + static_cast<std::size_t>(x));
      const auto from = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(layout.width) +
                             static_cast<std::size_t>(column.x));
      for (std::size_t c = 0; c < 3; ++c) {
        out.rgb[to + c] = column.divider ? kDivider : view.rgb[from + c];
      }
    }
  }
  return out;
}

render::FloatImage compose_channels(const PictureLayout& layout, const render::RenderedFrame& frame, bool all) {
  render::FloatImage out{layout.picture_width(), layout.height, {"R", "G", "B"}, {}};
  if (all) {
    out.channels.insert(out.channels.end(), {"depth", "V.hh", "V.hv", "V.vv", "blur", "accommodation"});
  }
  const auto count = static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height);
  out.planes.assign(out.channels.size(), std::vector<float>(count));
  for (int x = 0; x < out.width; ++x) {
    const PictureColumn column = picture_column(layout, x);
    const render::RenderedView& view = frame.views[column.view];
    const std::vector<float>* planes[] = {&view.wavefront.depth, &view.wavefront.v_hh, &view.wavefront.v_hv,
                                          &view.wavefront.v_vv,  &view.wavefront.blur, &view.wavefront.accommodation};
    for (int y = 0; y < out.height; ++y) {
      const auto to = static_cast<std::size_t>(y) * static_cast<std::size_t>(out.width) + static_cast<std::size_t>(x);
      const auto from =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(layout.width) + static_cast<std::size_t>(column.x);
      for (std::size_t c = 0; c < 3; ++c) {
        // A map has colours but no radiance: its display colours in linear light.
        out.planes[c][to] =
            view.radiance.empty() ? render::srgb_decode(view.display.rgb[3 * from + c]) : view.radiance[3 * from + c];
      }
      for (std::size_t c = 3; c < out.planes.size(); ++c) {
        out.planes[c][to] = (*planes[c - 3])[from];
      }
    }
  }
  return out;
}

}  // namespace app
