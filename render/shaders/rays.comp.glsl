#version 460
#extension GL_GOOGLE_include_directive : require
// The ray of every pixel beyond the lens, the chief one or a sample; those whose path does not settle at once are listed.
#define HURRIED true
#include "render/shaders/scene_bindings.glsl"
#include "render/shaders/shading.glsl"
#include "render/shaders/pixel.glsl"
#include "render/shaders/aim.glsl"
#include "render/shaders/ray_out.glsl"
#include "render/shaders/list.glsl"
#define SHOWN_TILES_AT 15
#include "render/shaders/group.glsl"
#include "render/shaders/columns.glsl"

layout(std430, binding = 12) buffer Unsettled { uint unsettled[]; };

void main() {
  int eye = frame.view.x;
  ViewData view = view_data(eye);
  for (int row = 0; row < kColumn; ++row) {
    ivec2 p = pixel_of_column(group_in_order(), row);
    if (p.x < frame.size.x && p.y < frame.size.y) {
      int at = (eye * frame.size.y + p.y) * frame.size.x + p.x;
      PixelRay ray = aim_pixel(view, p, at);
      if (LENS_USED && ray.status == kStatusUnsettled) {
        APPEND(unsettled, uint(at))
      }
      leave(view, ray, at);
    }
  }
}
