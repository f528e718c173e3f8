#version 460
#extension GL_GOOGLE_include_directive : require
// Approximate defocus where all that a blur reaches lies at one depth: the mean over the pixel's own ellipse.
#define SHOWN_TILES_AT 5
#include "render/shaders/gather.glsl"
#include "render/shaders/blurred_out.glsl"

layout(binding = 2) uniform usamplerBuffer levels;
layout(binding = 3) uniform usamplerBuffer reaches;
layout(binding = 4) uniform usamplerBuffer squares;

#include "render/shaders/disc_gather.glsl"

vec3 small_blur(Tap centre, ivec2 p, int base) {
  vec3 mean = centre.radiance;
  for (int k = 0; k < 9; ++k) {
    ivec2 o = ivec2(k % 3 - 1, k / 3 - 1);
    ivec2 q = clamp(p + o, ivec2(0), frame.size.xy - 1);
    Tap tap = tap_at(base + q.y * frame.size.x + q.x);
    float w = tap.depth < 0.0 ? 0.0 : small_weight(centre.ellipse, o);
    mean += w * (tap.radiance - centre.radiance);
  }
  return mean;
}

// Between the four squares around a pixel; a: 1 if all of them are there.
vec4 from_squares(ivec2 p) {
  ivec2 last = (frame.size.xy - 1) >> 1;
  ivec2 own = p >> 1;
  ivec2 other = clamp(own + 2 * (p & 1) - 1, ivec2(0), last);
  int width = blur_level_width(tile_count(), 1);
  vec4 mean = vec4(0.0);
  float all = 1.0;
  for (int k = 0; k < 4; ++k) {
    ivec2 at = ivec2((k & 1) != 0 ? other.x : own.x, (k & 2) != 0 ? other.y : own.y);
    uvec2 packed = texelFetch(squares, at.y * width + at.x).xy;
    vec4 square = vec4(unpackHalf2x16(packed.x), unpackHalf2x16(packed.y));
    mean += ((k & 1) != 0 ? 0.25 : 0.75) * ((k & 2) != 0 ? 0.25 : 0.75) * square;
    all = min(all, square.a);
  }
  return vec4(mean.rgb, all);
}

vec3 gathered_blur(Tap centre, float reach, ivec2 p, int base) {
  float minor = centre.ellipse.x + centre.ellipse.z - reach;
  if (kRate > 1 && minor >= kWideBlur) {
    vec4 mean = from_squares(p);
    if (mean.a > 0.0) {
      return mean.rgb;
    }
  }
  float area = ellipse_area(reach, minor);
  vec4 sum = disc_sum(centre.ellipse, area, vec2(p) + 0.5, level_of(area, minor), 0.0, base);
  return sum.a > 0.0 ? sum.rgb / sum.a : centre.radiance;
}

void main() {
  ivec2 p = pixel_in_picture();
  ivec2 size = frame.size.xy;
  if (p.x >= size.x || p.y >= size.y) {
    return;
  }
  int base = frame.view.x * size.x * size.y;
  Tap centre = tap_at(base + p.y * size.x + p.x);
  vec3 mean = centre.radiance;
  if (kTaps != 0) {
    ivec2 tile = p / kBlurTile;
    if (TILE_REACH(tile).x >= 0.0) {
      return;  // has layers
    }
    float reach = major(centre.ellipse);
    // The rim stays where it is, and what is in focus stays as it is, to the bit.
    if (centre.depth >= 0.0 && reach >= frame.limits.x) {
      mean = reach < 1.0 ? small_blur(centre, p, base) : gathered_blur(centre, reach, p, base);
    }
  }
  leave_blurred(base + p.y * size.x + p.x, mean);
}
