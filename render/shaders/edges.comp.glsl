#version 460
#extension GL_GOOGLE_include_directive : require
// Pixels at an edge - another material, face, status, depth or a jump of radiance beside them - get four rays more, on a
// rotated grid; the radiance becomes the mean over the pixel's square, the filter that every mode integrates.
#define FOOTPRINT_PIXELS 0.5  // four rays a pixel
#include "render/shaders/scene_bindings.glsl"
#include "render/shaders/shading.glsl"
#include "render/shaders/pixel.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(std430, binding = 10) buffer Pixels { uvec4 pixels[]; };
layout(std430, binding = 11) readonly buffer Keys { uvec2 keys[]; };

bool differs(uvec2 key, float depth, int at) {
  uvec2 other = keys[at];
  uint change = other.x ^ key.x;
  if ((change & 0xffffu) != 0u) {
    return true;
  }
  if (change != 0u) {
    ivec3 a = ivec3((uvec3(key.x) >> uvec3(16u, 21u, 26u)) & 31u);
    ivec3 b = ivec3((uvec3(other.x) >> uvec3(16u, 21u, 26u)) & 31u);
    ivec3 d = abs(a - b);
    if (d.x + d.y + d.z > 6) {
      return true;
    }
  }
  // Shadows and textures have edges too: a jump of more than an eighth.
  float luminance = uintBitsToFloat(key.y);
  float other_luminance = uintBitsToFloat(other.y);
  if (abs(other_luminance - luminance) > 0.125 * max(luminance, other_luminance) + 0.002) {
    return true;
  }
  float other_depth = uintBitsToFloat(pixels[at].w);
  return abs(other_depth - depth) > 0.05 * max(max(depth, other_depth), 0.0);
}

void main() {
  ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  int eye = int(gl_GlobalInvocationID.z);
  ivec2 size = frame.size.xy;
  if (p.x >= size.x || p.y >= size.y) {
    return;
  }
  int base = eye * size.x * size.y;
  int at = base + p.y * size.x + p.x;
  uvec2 key = keys[at];
  uvec4 pixel = pixels[at];
  float depth = uintBitsToFloat(pixel.w);
  bool edge = false;
  // Two pixels around, because a stroke thinner than a pixel may hide between the centres of the nearest ones.
  for (int k = 0; k < 25 && !edge; ++k) {
    ivec2 q = clamp(p + ivec2(k % 5 - 2, k / 5 - 2), ivec2(0), size - 1);
    edge = differs(key, depth, base + q.y * size.x + q.x);
  }
  if (!edge) {
    return;
  }
  ViewData view = views[eye];
  const vec2 offsets[4] =
      vec2[4](vec2(0.375, 0.125), vec2(0.875, 0.375), vec2(0.125, 0.625), vec2(0.625, 0.875));
  vec3 sum = vec3(unpackHalf2x16(pixel.x), unpackHalf2x16(pixel.y).x);
  for (int i = 0; i < 4; ++i) {
    sum += trace_pixel(view, pixel_direction(view, vec2(p) + offsets[i]), vec2(0.0), vec2(0.0)).radiance;
  }
  vec3 mean = sum * 0.2;
  pixels[at].x = packHalf2x16(mean.rg);
  pixels[at].y = packHalf2x16(vec2(mean.b, unpackHalf2x16(pixel.y).y));
}
