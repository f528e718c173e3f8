#version 460
#extension GL_GOOGLE_include_directive : require
// The end of a frame: linear radiance to sRGB, once.
#include "render/shaders/display.glsl"
#include "render/shaders/frame.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform usamplerBuffer radiance;
layout(std430, binding = 1) writeonly buffer Display { uint display[]; };
layout(push_constant) uniform Frame { FrameData frame; };
#define SHOWN_TILES_AT 2
#include "render/shaders/group.glsl"

void main() {
  ivec2 p = pixel_in_picture();
  if (p.x >= frame.size.x || p.y >= frame.size.y) {
    return;
  }
  int at = (frame.view.x * frame.size.y + p.y) * frame.size.x + p.x;
  display[at] = display_bytes(texelFetch(radiance, at).xy, frame.limits.z);
}
