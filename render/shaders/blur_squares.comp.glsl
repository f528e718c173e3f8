#version 460
#extension GL_GOOGLE_include_directive : require
// Wide blurs of one depth once for each square of 2 pixels; the blur stage interpolates between squares. A workgroup
// takes kSquaredTiles listed tiles.
#include "render/shaders/gather.glsl"

layout(std430, binding = 1) writeonly buffer Squares { uvec2 squares[]; };
layout(binding = 2) uniform usamplerBuffer reaches;
layout(binding = 3) uniform usamplerBuffer list;
#include "render/shaders/listed_tiles.glsl"

#include "render/shaders/disc_gather.glsl"

void gather_square(ivec2 tile, ivec2 square) {
  int width = blur_level_width(tile_count(), 1);
  float least = 1e30;
  vec3 ellipse = vec3(0.0);
  for (int k = 0; k < 4; ++k) {
    ivec2 q = min(2 * square + ivec2(k & 1, k >> 1), frame.size.xy - 1);
    Tap tap = tap_at(q.y * pixels_a_row() + q.x);
    ellipse += 0.25 * tap.ellipse;
    least = tap.depth < 0.0 ? 0.0 : min(least, tap.ellipse.x + tap.ellipse.z - major(tap.ellipse));
  }
  bool wide = least >= kWideBlur && TILE_REACH(tile).x == -1.0;
  vec4 sum = vec4(0.0);
  if (wide) {
    float reach = major(ellipse);
    float minor = ellipse.x + ellipse.z - reach;
    float area = ellipse_area(reach, minor);
    // Interpolating with weights of 3/4 at half a pixel and 1/4 at one and a half.
    sum = disc_sum(ellipse, area, 2.0 * vec2(square) + 1.0, level_of(area, minor), 0.75);
  }
  vec3 mean = sum.rgb / max(sum.a, 1e-6);
  squares[square.y * width + square.x] =
      uvec2(packHalf2x16(mean.rg), packHalf2x16(vec2(mean.b, sum.a > 0.0 ? 1.0 : 0.0)));
}

void main() {
  const int side = kBlurTile / 2;
  int lane = int(gl_LocalInvocationIndex);
  uint place = kSquaredTiles * listed_place() + uint(lane / (side * side));
  ivec2 tile = listed_tile(place);
  ivec2 square = side * tile + ivec2(lane % side, lane / side % side);
  if (is_listed(place) && all(lessThan(2 * square, frame.size.xy))) {
    gather_square(tile, square);
  }
}
