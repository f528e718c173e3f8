#version 460
#extension GL_GOOGLE_include_directive : require
// The listed pixels get four rays more, on a rotated grid; the radiance becomes the mean over the pixel's square, the
// filter that every mode integrates.
#define FOOTPRINT_PIXELS 0.5  // four rays a pixel
#include "render/shaders/scene_bindings.glsl"
#include "render/shaders/shading.glsl"
#include "render/shaders/pixel.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 10) buffer Pixels { uvec4 pixels[]; };
layout(std430, binding = 11) readonly buffer Edges { uint edges[]; };  // this view's alone

void main() {
  ViewData view = views[frame.view.x];
  const vec2 offsets[4] =
      vec2[4](vec2(0.375, 0.125), vec2(0.875, 0.375), vec2(0.125, 0.625), vec2(0.625, 0.875));
  uint count = edges[kListCountAt];
  for (uint i = gl_GlobalInvocationID.x; i < count; i += kListGroup * gl_NumWorkGroups.x) {
    int at = int(edges[kListFirstAt + i]);
    int in_view = at - frame.view.x * frame.size.x * frame.size.y;
    vec2 p = vec2(float(in_view % frame.size.x), float(in_view / frame.size.x));
    uvec4 pixel = pixels[at];
    vec3 sum = vec3(unpackHalf2x16(pixel.x), unpackHalf2x16(pixel.y).x);
    for (int k = 0; k < 4; ++k) {
      sum += trace_pixel(view, pixel_direction(view, p + offsets[k]), vec2(0.0), vec2(0.0)).radiance;
    }
    vec3 mean = sum * 0.2;
    pixels[at].x = packHalf2x16(mean.rg);
    pixels[at].y = packHalf2x16(vec2(mean.b, unpackHalf2x16(pixel.y).y));
  }
}
