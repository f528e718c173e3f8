#version 460
#extension GL_GOOGLE_include_directive : require
// The end of a frame: linear radiance to sRGB, once; or a scalar of the wavefront to colour (paper, section 6.1).
#include "render/image/gpu/colour_map.h"
#include "render/shaders/frame.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(std430, binding = 0) readonly buffer Radiance { uvec2 radiance[]; };
layout(std430, binding = 1) readonly buffer Wavefronts { vec4 wavefronts[]; };
layout(std430, binding = 2) writeonly buffer Display { uint display[]; };
layout(push_constant) uniform Frame { FrameData frame; };

float srgb(float x) { return x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1.0 / 2.4) - 0.055; }

void main() {
  ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (p.x >= frame.size.x || p.y >= frame.size.y) {
    return;
  }
  int at = (frame.view.x * frame.size.y + p.y) * frame.size.x + p.x;
  vec3 shown;
  if (frame.size.w <= kModeDof) {
    uvec2 packed = radiance[at];
    vec3 linear = vec3(unpackHalf2x16(packed.x), unpackHalf2x16(packed.y).x) * frame.limits.z;
    linear = clamp(linear, vec3(0.0), vec3(1.0));
    shown = vec3(srgb(linear.r), srgb(linear.g), srgb(linear.b));
  } else {
    vec4 v = wavefronts[kWavefrontTexels * at];
    vec4 more = wavefronts[kWavefrontTexels * at + 1];
    float difference = v.x - v.z;
    float value = frame.size.w == kModePower          ? 0.5 * (v.x + v.z)
                  : frame.size.w == kModeAstigmatism  ? sqrt(difference * difference + 4.0 * v.y * v.y)
                  : frame.size.w == kModeAccommodation ? v.w
                                                       : more.x;
    value *= frame.map_range.z;
    float x = clamp((value - frame.map_range.x) / max(frame.map_range.y - frame.map_range.x, 1e-9), 0.0, 1.0);
    shown = more.y < 0.0 ? vec3(0.13) : colour_map(frame.sampling.w, x);
  }
  uvec3 c = uvec3(round(shown * 255.0));
  display[at] = c.r | (c.g << 8) | (c.b << 16) | 0xff000000u;
}
