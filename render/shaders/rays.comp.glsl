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

layout(local_size_x = 8, local_size_y = 8) in;
layout(std430, binding = 12) buffer Unsettled { uint unsettled[]; };

void main() {
  ivec2 p = pixel_in_order();
  int eye = frame.view.x;
  if (p.x >= frame.size.x || p.y >= frame.size.y) {
    return;
  }
  ViewData view = views[eye];
  int at = (eye * frame.size.y + p.y) * frame.size.x + p.x;
  PixelRay ray = aim_pixel(view, p, at);
  if (LENS_USED && ray.status == kStatusUnsettled) {
    APPEND(unsettled, uint(at))
  }
  leave(view, ray, at);
}
