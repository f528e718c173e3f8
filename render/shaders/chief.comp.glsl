#version 460
#extension GL_GOOGLE_include_directive : require
// One chief ray a pixel, through the pixel's centre, all the way by itself.
#include "render/shaders/scene_bindings.glsl"
#include "render/shaders/shading.glsl"
#include "render/shaders/pixel.glsl"
#define SHOWN_TILES_AT 13
#include "render/shaders/group.glsl"
#include "render/shaders/chief_out.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

void main() {
  ivec2 p = pixel_in_picture();
  int eye = frame.view.x;
  if (p.x >= frame.size.x || p.y >= frame.size.y) {
    return;
  }
  ViewData view = view_data(eye);
  int at = (eye * frame.size.y + p.y) * frame.size.x + p.x;
  vec3 direction = pixel_direction(view, vec2(p) + 0.5);
  leave_pixel(view, trace_pixel(view, direction, vec2(0.0), vec2(0.0)), at);
}
