// Where a pixel's ray sets out: the chief ray through the pixel's centre and the pupil's, or one sample of the
// distributed rays (paper, section 6.2), which takes another point of the pixel and of the pupil.
#include "render/shaders/sample_pattern.h"

layout(constant_id = 8) const uint kSampled = 0u;  // 1: distributed rays

layout(binding = 13) uniform samplerBuffer kept_wavefronts;  // of the chief rays; read where each has its own focus

struct Aim {
  vec3 direction;     // unit, primary axes
  vec2 pupil_offset;  // m, in the ray's basis of the pupil plane
  vec2 momentum;      // of the direction, in the same basis
};

// The ray through pupil offset s leaves with p = -(E - I/l) s relative to the chief ray, so that all rays of a pixel
// meet again on the retina. That needs no focal lines.
vec2 sample_momentum(ViewData view, vec2 s, int at) {
  float accommodation = view.eye.pupil.z;
  if (accommodation < 0.0) {
    accommodation = texelFetch(kept_wavefronts, kWavefrontTexels * at).w;
  }
  vec3 excess = view.eye.excess.xyz + vec3(accommodation, 0.0, accommodation);
  return -vec2(excess.x * s.x + excess.y * s.y, excess.y * s.x + excess.z * s.y);
}

// p: the pixel, `at` its place among those of all views. The frame's sampling says which sample it is.
Aim pixel_aim(ViewData view, ivec2 p, int at) {
  Aim aim;
  aim.pupil_offset = vec2(0.0);
  aim.momentum = vec2(0.0);
  vec2 within = vec2(0.5);
  if (kSampled != 0u) {
    vec4 u = sample_pattern(frame.sample_point, uint(frame.sampling.x), uvec2(p), uint(frame.sampling.z));
    within = u.zw;
    aim.pupil_offset = 0.5 * view.eye.pupil.x * to_disc(u.xy);
    aim.momentum = sample_momentum(view, aim.pupil_offset, at);
  }
  aim.direction = pixel_direction(view, vec2(p) + within);
  return aim;
}

PixelRay aim_pixel(ViewData view, ivec2 p, int at) {
  Aim aim = pixel_aim(view, p, at);
  return aim_pixel(view, aim.direction, aim.pupil_offset, aim.momentum);
}
