#version 460
#extension GL_GOOGLE_include_directive : require
// Approximate defocus to linear radiance.
#include "render/shaders/gather.glsl"

layout(std430, binding = 1) writeonly buffer Blurred { uvec2 blurred[]; };

void main() {
  ivec2 p = pixel_in_picture();
  ivec2 size = frame.size.xy;
  if (p.x >= size.x || p.y >= size.y) {
    return;
  }
  int base = frame.view.x * size.x * size.y;
  blurred[base + p.y * size.x + p.x] = blurred_pixel(p, base);
}
