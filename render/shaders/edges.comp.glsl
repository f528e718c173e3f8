#version 460
#extension GL_GOOGLE_include_directive : require
// The listed pixels get four rays more, and where these and the first disagree, or a beam knows of more, a second round
// of four; the radiance becomes the mean over the pixel's square, the filter that every mode integrates. The nine points
// share no row and no column, so that a level or upright stroke counts by its width.
#define FOOTPRINT_PIXELS 0.5  // four rays a pixel
#include "render/shaders/scene_bindings.glsl"
#include "render/shaders/shading.glsl"
#include "render/shaders/pixel.glsl"
#include "render/shaders/list.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 10) buffer Pixels { uvec4 pixels[]; };
layout(std430, binding = 11) readonly buffer Edges { uint edges[]; };  // this view's alone
layout(std430, binding = 12) buffer Uneven { uint uneven[]; };         // made by the first round for the second

void main() {
  ViewData view = view_data(frame.view.x);
  bool again = frame.view.y != 0;
  const vec2 offsets[4] =
      vec2[4](vec2(0.375, 0.125), vec2(0.875, 0.375), vec2(0.125, 0.625), vec2(0.625, 0.875));
  const vec2 more_offsets[4] =
      vec2[4](vec2(0.734, 0.031), vec2(0.031, 0.266), vec2(0.969, 0.734), vec2(0.266, 0.969));
  float before = again ? 5.0 : 1.0;  // rays in the pixel so far
  uint count = edges[kListCountAt];
  for (uint i = gl_GlobalInvocationID.x; i < count; i += kListGroup * gl_NumWorkGroups.x) {
    uint item = edges[kListFirstAt + i];
    int at = int(item & ~kListThin);
    int in_view = at - frame.view.x * frame.size.x * frame.size.y;
    vec2 p = vec2(float(in_view % frame.size.x), float(in_view / frame.size.x));
    uvec4 pixel = pixels[at];
    vec3 mean = vec3(unpackHalf2x16(pixel.x), unpackHalf2x16(pixel.y).x);
    vec3 sum = before * mean;
    vec3 least = mean;
    vec3 most = mean;
    for (int k = 0; k < 4; ++k) {
      vec2 offset = again ? more_offsets[k] : offsets[k];
      vec3 radiance = trace_pixel(view, pixel_direction(view, p + offset), vec2(0.0), vec2(0.0)).radiance;
      sum += radiance;
      least = min(least, radiance);
      most = max(most, radiance);
    }
    mean = sum / (before + 4.0);
    pixels[at].x = packHalf2x16(mean.rg);
    pixels[at].y = packHalf2x16(vec2(mean.b, unpackHalf2x16(pixel.y).y));
    if (!again && ((item & kListThin) != 0u || any(greaterThan(most - least, 0.125 * most + 0.002)))) {
      APPEND(uneven, uint(at))
    }
  }
}
