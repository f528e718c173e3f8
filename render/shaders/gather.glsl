// Approximate defocus (paper, section 6.3): each pixel gathers over its own blur ellipse. The ellipse comes from the
// eigenvalues of the residual, and the kernel is the uniform ellipse of a round pupil rather than the paper's Gaussian.
// A neighbour in front of this pixel counts only as far as its own blur reaches here, so that nothing sharp bleeds.
#include "render/shaders/frame.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform usamplerBuffer pixels;
layout(push_constant) uniform Frame { FrameData frame; };
#include "render/shaders/group.glsl"

struct Tap {
  vec3 radiance;
  vec3 ellipse;
  float depth;
};

Tap tap_at(int at) {
  uvec4 p = texelFetch(pixels, at);
  vec2 rg = unpackHalf2x16(p.x);
  vec2 bx = unpackHalf2x16(p.y);
  Tap tap;
  tap.radiance = vec3(rg, bx.x);
  tap.ellipse = vec3(bx.y, unpackHalf2x16(p.z));
  tap.depth = uintBitsToFloat(p.w);
  return tap;
}

// 1/depth orders points from near to far with the sky last.
float nearness(float depth) { return depth > 0.0 ? 1.0 / depth : 0.0; }

float major(vec3 s) { return 0.5 * (s.x + s.z) + sqrt(0.25 * (s.x - s.z) * (s.x - s.z) + s.y * s.y); }

// How far inside its own blur ellipse a point at `offset` from a tap lies: 1 inside, 0 outside, a pixel's width between.
float covers(vec3 s, vec2 offset) {
  float trace = s.x + s.z;
  // Half a pixel more than the ellipse, so that a blur smaller than the pixel grid still covers its own pixel.
  vec3 wide = s + vec3(0.5, 0.0, 0.5);
  float det = wide.x * wide.z - wide.y * wide.y;
  vec2 inner = vec2(wide.z * offset.x - wide.y * offset.y, wide.x * offset.y - wide.y * offset.x) / max(det, 1e-6);
  return clamp((1.0 - length(inner)) * (0.5 * trace + 0.5) + 0.5, 0.0, 1.0);
}

// How much a tap at `offset` may give: all of it from beside or behind, and from in front as far as its blur reaches.
float visible_share(Tap tap, float here, vec2 offset) {
  float in_front = clamp((nearness(tap.depth) - here) * 20.0 / max(here, 0.05), 0.0, 1.0);
  return tap.depth < 0.0 ? 0.0 : mix(1.0, covers(tap.ellipse, offset), in_front);
}

// A blur within the pixel: the nine weights with the ellipse's own second moments, S S^T / 4.
vec3 small_blur(Tap centre, ivec2 p, int base) {
  vec3 s = centre.ellipse;
  vec3 m = 0.25 * vec3(s.x * s.x + s.y * s.y, s.y * (s.x + s.z), s.y * s.y + s.z * s.z);
  float diagonal = 0.5 * abs(m.y);
  vec2 straight = max(0.5 * m.xz - diagonal, vec2(0.0));
  float here = nearness(centre.depth);
  vec3 mean = centre.radiance;
  for (int k = 0; k < 9; ++k) {
    ivec2 o = ivec2(k % 3 - 1, k / 3 - 1);
    bool leans = o.x * o.y != 0 && float(o.x * o.y) * m.y > 0.0;
    float w = leans ? diagonal : (o.y == 0 && o.x != 0 ? straight.x : (o.x == 0 && o.y != 0 ? straight.y : 0.0));
    ivec2 q = clamp(p + o, ivec2(0), frame.size.xy - 1);
    Tap tap = tap_at(base + q.y * frame.size.x + q.x);
    mean += w * visible_share(tap, here, vec2(o)) * (tap.radiance - centre.radiance);
  }
  return mean;
}

vec3 gathered_blur(Tap centre, float reach, ivec2 p, int base) {
  vec3 s = centre.ellipse;
  float minor = max(s.x + s.z - reach, 0.5);
  int taps = int(clamp(3.0 * reach * minor, 16.0, 512.0));  // about one a pixel of the ellipse
  float here = nearness(centre.depth);
  vec3 sum = centre.radiance;
  float weight = 1.0;
  vec2 turn = vec2(1.0, 0.0);
  const vec2 golden = vec2(-0.7373688780783197, 0.6754902942615238);
  for (int k = 0; k < taps; ++k) {
    float radius = sqrt((float(k) + 0.5) / float(taps));
    turn = vec2(turn.x * golden.x - turn.y * golden.y, turn.x * golden.y + turn.y * golden.x);
    vec2 disc = turn * radius;
    ivec2 q = p + ivec2(round(vec2(s.x * disc.x + s.y * disc.y, s.y * disc.x + s.z * disc.y)));
    q = clamp(q, ivec2(0), frame.size.xy - 1);
    Tap tap = tap_at(base + q.y * frame.size.x + q.x);
    float w = visible_share(tap, here, vec2(q - p));
    sum += w * tap.radiance;
    weight += w;
  }
  return sum / weight;
}

// Linear radiance as two words of half floats.
uvec2 blurred_pixel(ivec2 p, int base) {
  Tap centre = tap_at(base + p.y * frame.size.x + p.x);
  float reach = major(centre.ellipse);
  vec3 mean = centre.radiance;
  // The rim stays where it is, and what is in focus stays as it is, to the bit.
  if (centre.depth >= 0.0 && reach >= frame.limits.x) {
    mean = reach < 1.0 ? small_blur(centre, p, base) : gathered_blur(centre, reach, p, base);
  }
  return uvec2(packHalf2x16(mean.rg), packHalf2x16(vec2(mean.b, 1.0)));
}
