// Approximate defocus (paper, section 6.3): each pixel gathers over its own blur ellipse. The ellipse comes from the
// eigenvalues of the residual, and the kernel is the uniform ellipse of a round pupil rather than the paper's Gaussian,
// which kGaussian asks for. Here: what its kernels share.
#include "render/shaders/frame.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant) uniform Frame { FrameData frame; };
layout(constant_id = 0) const int kMostRings = 0;  // of a gathered blur's taps (ring_points); 0: nothing is blurred
layout(constant_id = 1) const uint kGaussian = 0u;
layout(constant_id = 2) const uint kEncode = 0u;  // 1: to the display's bytes, 0: to linear radiance
layout(constant_id = 3) const int kRate = 1;  // px between gathered ones where the minor semi-axis is 4 px or more
layout(binding = 0) uniform usamplerBuffer pixels;

const float kPi = 3.14159265358979;
// How far a kernel reaches, in radii of the disc: a Gaussian of the disc's second moments has lost 0.03 % there.
float kernel_reach() { return kGaussian != 0u ? 2.0 : 1.0; }

struct Tap {
  vec3 radiance;
  vec3 ellipse;
  float depth;
};

Tap unpack_tap(uvec4 p) {
  vec2 rg = unpackHalf2x16(p.x);
  vec2 bx = unpackHalf2x16(p.y);
  Tap tap;
  tap.radiance = vec3(rg, bx.x);
  tap.ellipse = vec3(bx.y, unpackHalf2x16(p.z));
  tap.depth = uintBitsToFloat(p.w);
  return tap;
}

// Of a square of 2 pixels what lies nearest: its share of the square, and its means.
struct Square {
  vec3 radiance;
  float coverage;
  vec3 ellipse;
  float nearness;
};

uvec4 pack_square(Square square) {
  return uvec4(packHalf2x16(square.radiance.rg), packHalf2x16(vec2(square.radiance.b, square.ellipse.x)),
               packHalf2x16(square.ellipse.yz), packHalf2x16(vec2(square.nearness, square.coverage)));
}

Square unpack_square(uvec4 p) {
  vec2 bx = unpackHalf2x16(p.y);
  vec2 nc = unpackHalf2x16(p.w);
  return Square(vec3(unpackHalf2x16(p.x), bx.x), nc.y, vec3(bx.y, unpackHalf2x16(p.z)), nc.x);
}

Tap tap_at(int at) { return unpack_tap(texelFetch(pixels, at)); }

// 1/depth orders points from near to far with the sky last.
float nearness(float depth) { return depth > 0.0 ? 1.0 / depth : 0.0; }

float major(vec3 s) { return 0.5 * (s.x + s.z) + sqrt(0.25 * (s.x - s.z) * (s.x - s.z) + s.y * s.y); }

ivec2 tile_count() { return (frame.size.xy + kBlurTile - 1) / kBlurTile; }

// An ellipse whose second moments are less by `variance` (px^2) along every direction: what the taps' own size adds.
vec3 shrunk(vec3 s, float variance) {
  float a = major(s);
  float b = max(s.x + s.z - a, 0.0);
  // A uniform disc's second moments are a quarter of its squared radius.
  float a_less = sqrt(max(a * a - 4.0 * variance, 0.0));
  float b_less = sqrt(max(b * b - 4.0 * variance, 0.0));
  float slope = a - b > 1e-3 * a ? (a_less - b_less) / (a - b) : 0.0;
  float level = a_less - slope * a;
  return slope * s + vec3(level, 0.0, level);
}

// Rings of a round pattern: ring j of n has 8 j + 4 points, so that all (2n)^2 stand for equal parts of the kernel, and
// no ring favours a direction.
int ring_points(int ring) { return 8 * ring + 4; }

// The radius at which a ring's points have the second moment of the ring they stand for.
float ring_radius(int ring, int rings) {
  float inner = float(ring * ring) / float(rings * rings);
  float outer = float((ring + 1) * (ring + 1)) / float(rings * rings);
  if (kGaussian == 0u) {
    return sqrt(0.5 * (inner + outer));
  }
  // The integral of -log(1 - u): the squared radius, in 2 sigma^2, inside which the part u of a Gaussian lies.
  float up_to_inner = inner + (1.0 - inner) * log(1.0 - inner);
  float up_to_outer = outer + (1.0 - outer) * log(max(1.0 - outer, 1e-6));
  return sqrt(0.5 * (up_to_outer - up_to_inner) / (outer - inner));
}

// Each ring begins at another angle, by the golden section.
vec2 ring_start(int ring) {
  float angle = 2.399963229728653 * float(ring);
  return vec2(cos(angle), sin(angle));
}

// About one tap a pixel of the ellipse, within the most.
int rings_of(float area, int most) { return clamp(int(ceil(0.5 * sqrt(area))), 1, most); }

// The nine weights of a blur within the pixel, with the ellipse's own second moments, S S^T / 4.
float small_weight(vec3 s, ivec2 o) {
  vec3 m = 0.25 * vec3(s.x * s.x + s.y * s.y, s.y * (s.x + s.z), s.y * s.y + s.z * s.z);
  float diagonal = 0.5 * abs(m.y);
  vec2 straight = max(0.5 * m.xz - diagonal, vec2(0.0));
  bool leans = o.x * o.y != 0 && float(o.x * o.y) * m.y > 0.0;
  return leans ? diagonal : (o.y == 0 && o.x != 0 ? straight.x : (o.x == 0 && o.y != 0 ? straight.y : 0.0));
}
