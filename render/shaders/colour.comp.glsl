#version 460
#extension GL_GOOGLE_include_directive : require
// The end of a map: a scalar of the wavefront to colour (paper, section 6.1).
#include "render/image/gpu/colour_map.h"
#include "render/shaders/display.glsl"
#include "render/shaders/frame.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform samplerBuffer wavefronts;
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
  vec4 v = texelFetch(wavefronts, kWavefrontTexels * at);
  vec4 more = texelFetch(wavefronts, kWavefrontTexels * at + 1);
  float difference = v.x - v.z;
  float value = frame.size.w == kModePower           ? 0.5 * (v.x + v.z)
                : frame.size.w == kModeAstigmatism   ? sqrt(difference * difference + 4.0 * v.y * v.y)
                : frame.size.w == kModeAccommodation ? v.w
                                                     : more.x;
  value *= frame.map_range.z;
  float x = clamp((value - frame.map_range.x) / max(frame.map_range.y - frame.map_range.x, 1e-9), 0.0, 1.0);
  display[at] = display_bytes(more.y < 0.0 ? vec3(0.13) : colour_map(frame.sampling.w, x));
}
