#version 460
#extension GL_GOOGLE_include_directive : require
// Approximate defocus straight to the display's bytes: as blur and encode one after the other.
#include "render/shaders/gather.glsl"
#include "render/shaders/display.glsl"

layout(std430, binding = 1) writeonly buffer Display { uint display[]; };

void main() {
  ivec2 p = pixel_in_picture();
  ivec2 size = frame.size.xy;
  if (p.x >= size.x || p.y >= size.y) {
    return;
  }
  int base = frame.view.x * size.x * size.y;
  display[base + p.y * size.x + p.x] = display_bytes(blurred_pixel(p, base), frame.limits.z);
}
