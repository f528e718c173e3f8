#include "xr/panel.hpp"

#include "xr/convert.hpp"

namespace xr {

Panel::Panel(const Session& session, const Space& head, int most_width, int most_height)
    : head_(head), swapchain_(session, {.width = most_width, .height = most_height}) {}

void Panel::show(const PanelShape& shape) {
  swapchain_.release();
  shape_ = shape;
  is_empty_ = false;
}

XrCompositionLayerQuad Panel::layer() const {
  XrCompositionLayerQuad layer{};
  layer.type = XR_TYPE_COMPOSITION_LAYER_QUAD;
  layer.layerFlags = XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT;
  layer.space = head_.handle();
  layer.eyeVisibility = XR_EYE_VISIBILITY_BOTH;
  layer.subImage.swapchain = swapchain_.handle();
  layer.subImage.imageRect = {{shape_.shown.x, shape_.shown.y}, {shape_.shown.width, shape_.shown.height}};
  layer.pose = to_xr(shape_.head_from_panel);
  layer.size = {static_cast<float>(shape_.width), static_cast<float>(shape_.height)};
  return layer;
}

}  // namespace xr
