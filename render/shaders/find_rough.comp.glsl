#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
// Which tiles' rays run smoothly enough through the lens to be cubics between their corners' (tile_cubics.glsl); the
// others go on the list of those whose pixels are traced one by one. An invocation looks at a tile.
#include "render/shaders/frame.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform samplerBuffer corners;
layout(std430, binding = 1) writeonly buffer Smooth { uint is_smooth[]; };  // a word a tile, view after view
layout(std430, binding = 2) writeonly buffer Rough { uint rough[]; };       // as lists of shown tiles (group.glsl)
layout(std430, binding = 3) buffer Counts { uvec4 counts[]; };              // workgroups x, y, z of each view; how many
layout(push_constant) uniform Frame { FrameData frame; };
#define SHOWN_TILES_AT 4
#include "render/shaders/group.glsl"

// The largest third difference between corners. A cubic errs by two thirds of it at most where the lens's curvature
// changes its slope, at a spline's knots, and by far less elsewhere (NOTES.md): 0.005 D.
const float kMostPowerTerm = 7e-3;  // D
// To the first difference, 8/3 pixels: errors stay below a ten-thousandth of a pixel. What the corners' own rounding adds
// to it tells nothing.
const float kMostSlopeTerm = 7.5e-4;
const float kSlopeRounding = 4e-6;

float largest(vec4 v) { return max(max(abs(v.x), abs(v.y)), max(abs(v.z), abs(v.w))); }

// Whether the tile's 4 x 4 corners are of rays that pass and have small third differences along both directions.
bool runs_smoothly(ivec2 first) {
  const float third[4] = {-1.0, 3.0, -3.0, 1.0};
  ivec2 count = ivec2(frame.corners.zw);
  vec4 slope_down[4] = {vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0)};
  vec4 power_down[4] = {vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0)};
  float slope = 0.0;
  float power = 0.0;
  float code = 0.0;
  vec3 step;
  [[unroll]] for (int j = 0; j < 4; ++j) {
    int at = kCornerTexels * ((frame.view.x * count.y + first.y + j) * count.x + first.x);
    vec4 slope_across = vec4(0.0);
    vec4 power_across = vec4(0.0);
    [[unroll]] for (int i = 0; i < 4; ++i) {
      vec4 direction = texelFetch(corners, at + kCornerTexels * i + 1);
      vec4 bend = texelFetch(corners, at + kCornerTexels * i + 4);
      code += direction.w;
      step = (i == 0 && j == 0) ? -direction.xyz : (i == 3 && j == 0) ? step + direction.xyz : step;
      direction.w = 0.0;
      slope_across += third[i] * direction;
      power_across += third[i] * bend;
      slope_down[i] += third[j] * direction;
      power_down[i] += third[j] * bend;
    }
    slope = max(slope, largest(slope_across));
    power = max(power, largest(power_across));
  }
  [[unroll]] for (int i = 0; i < 4; ++i) {
    slope = max(slope, largest(slope_down[i]));
    power = max(power, largest(power_down[i]));
  }
  // So that what is not a number is rough.
  return code == 0.0 && power <= kMostPowerTerm && slope <= kMostSlopeTerm / 3.0 * length(step) + kSlopeRounding;
}

void main() {
  ivec2 tiles = (frame.size.xy + 7) / 8;
  int words = frame.sampling.y;
  uvec2 tile = gl_GlobalInvocationID.xy;
  bool looked_at = all(lessThan(ivec2(tile), tiles));
  if (kListedTiles != 0u) {
    tile = shown_tile(looked_at ? tile.y * uint(tiles.x) + tile.x : 0u);
    looked_at = looked_at && all(lessThan(tile, uvec2(tiles)));
  }
  ivec2 at = looked_at ? ivec2(tile) : ivec2(0);
  bool is_even = runs_smoothly(3 * at);
  if (looked_at) {
    is_smooth[frame.view.x * words + at.y * tiles.x + at.x] = is_even ? 1u : 0u;
  }
  if (looked_at && !is_even) {
    uint place = atomicAdd(counts[frame.view.x].w, 1u);
    rough[frame.view.x * words + int(place)] = tile.x | tile.y << 16;
    if (place < kListAcross) {
      atomicAdd(counts[frame.view.x].x, 1u);
    }
    if (place % kListAcross == 0u) {
      atomicAdd(counts[frame.view.x].y, 1u);
    }
  }
}
