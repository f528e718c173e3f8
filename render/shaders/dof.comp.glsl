#version 460
#extension GL_GOOGLE_include_directive : require
// Distributed rays (paper, section 6.2): one more ray a pixel through another point of the pixel and of the pupil, each
// traced through the real lens. The ray through pupil offset s leaves with p = -(E - I/l) s relative to the chief ray,
// which needs no focal lines. Sums and squares stay in a buffer between samples.
#define FOOTPRINT_PIXELS 0.25  // the samples themselves average over the pixel
#include "render/shaders/scene_bindings.glsl"
#include "render/shaders/shading.glsl"
#include "render/shaders/pixel.glsl"
#include "render/shaders/group.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(std430, binding = 10) readonly buffer Wavefronts { vec4 wavefronts[]; };
layout(std430, binding = 11) buffer Sums { vec4 sums[]; };  // r, g, b; w: squares of luminance
layout(std430, binding = 12) writeonly buffer Blurred { uvec2 blurred[]; };

uint hash(uint x) {
  // A full-period mix of Wang's kind: every input bit reaches every output bit.
  x = (x ^ 61u) ^ (x >> 16);
  x *= 9u;
  x ^= x >> 4;
  x *= 0x27d4eb2du;
  return x ^ (x >> 15);
}

// The four-dimensional additive recurrence with the generalised golden ratio, shifted by a pixel's own phase. The
// phase depends on the pixel alone: both eyes see the same pattern.
vec4 low_discrepancy(uint index, uvec2 pixel, uint seed) {
  // The powers of 1/1.16730..., in units of 2^-32, so that no index loses digits.
  const uvec4 step = uvec4(3679390609u, 3152041523u, 2700274806u, 2313257605u);
  uint h = hash(pixel.x + 65536u * pixel.y + seed * 0x9e3779b9u);
  uvec4 phase = uvec4(h, hash(h + 1u), hash(h + 2u), hash(h + 3u));
  return vec4((phase + index * step) >> 8) / 16777216.0;
}

// Area-preserving map of the unit square to the unit disc (Shirley and Chiu 1997).
vec2 to_disc(vec2 square) {
  vec2 c = 2.0 * square - 1.0;
  if (c.x == 0.0 && c.y == 0.0) {
    return vec2(0.0);
  }
  bool wide = abs(c.x) > abs(c.y);
  float radius = wide ? c.x : c.y;
  float angle = wide ? 0.7853981633974483 * c.y / c.x : 1.5707963267948966 - 0.7853981633974483 * c.x / c.y;
  return radius * vec2(cos(angle), sin(angle));
}

void main() {
  ivec2 p = pixel_in_picture();
  int eye = frame.view.x;
  if (p.x >= frame.size.x || p.y >= frame.size.y) {
    return;
  }
  ViewData view = views[eye];
  int at = (eye * frame.size.y + p.y) * frame.size.x + p.x;
  vec4 u = low_discrepancy(uint(frame.sampling.x), uvec2(p), uint(frame.sampling.z));
  vec2 s = 0.5 * view.eye.pupil.x * to_disc(u.zw);
  float accommodation = wavefronts[kWavefrontTexels * at].w;
  vec3 excess = view.eye.excess.xyz + vec3(accommodation, 0.0, accommodation);
  vec2 momentum = -vec2(excess.x * s.x + excess.y * s.y, excess.y * s.x + excess.z * s.y);
  PixelRay ray = trace_pixel(view, pixel_direction(view, vec2(p) + u.xy), s, momentum);
  float luminance = dot(ray.radiance, vec3(0.2126, 0.7152, 0.0722));
  vec4 sum = vec4(ray.radiance, luminance * luminance);
  if (frame.sampling.x > 0) {
    sum += sums[at];
  }
  sums[at] = sum;
  vec3 mean = sum.rgb / float(frame.sampling.x + 1);
  blurred[at] = uvec2(packHalf2x16(mean.rg), packHalf2x16(vec2(mean.b, 1.0)));
}
