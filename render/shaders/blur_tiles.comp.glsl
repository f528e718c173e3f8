#version 460
#extension GL_GOOGLE_include_directive : require
// What each tile of a picture holds: its largest blur, its nearest and farthest point, the largest blur of what lies
// nearest, whose sign is set where neighbours may share gathers. Tiles in focus go out as they are, to the bit. An
// invocation for each tile.
#include "render/shaders/gather.glsl"
#include "render/shaders/blurred_out.glsl"

layout(std430, binding = 2) writeonly buffer Tiles { vec4 tiles[]; };
layout(std430, binding = 3) buffer Wide { uint wide[]; };  // kWideGroupsAt, kWidestAt

// Reach, nearest, farthest, reach of what lies within a depth of the nearest so far.
vec4 extremes(ivec2 corner, ivec2 within, int base) {
  float apart = kBlurParallax / frame.limits.w;  // D
  vec4 tile = vec4(0.0, 0.0, 1e30, 0.0);
  for (int row = 0; row < within.y; ++row) {
    int at = base + (corner.y + row) * frame.size.x + corner.x;
    for (int column = 0; column < within.x; ++column) {
      Tap tap = tap_at(at + column);
      if (tap.depth >= 0.0) {
        float reach = major(tap.ellipse);
        float here = nearness(tap.depth);
        tile.w = max(here > tile.y + apart ? 0.0 : tile.w, here >= tile.y - apart ? reach : 0.0);
        tile.xy = max(tile.xy, vec2(reach, here));
        tile.z = min(tile.z, here);
      }
    }
  }
  return tile;
}

// As a pixel in the tile's middle says.
bool may_share(ivec2 corner, int base) {
  ivec2 middle = min(corner + kBlurTile / 2, frame.size.xy - 1);
  vec3 ellipse = tap_at(base + middle.y * frame.size.x + middle.x).ellipse;
  return kRate > 1 && ellipse.x + ellipse.z - major(ellipse) >= kWideBlur;
}

void main() {
  ivec2 tile = pixel_in_picture();
  if (any(greaterThanEqual(tile, tile_count()))) {
    return;
  }
  int base = frame.view.x * frame.size.x * frame.size.y;
  ivec2 corner = kBlurTile * tile;
  ivec2 within = min(ivec2(kBlurTile), frame.size.xy - corner);
  if (kTaps != 0) {
    vec4 found = extremes(corner, within, base);
    float near_reach = may_share(corner, base) ? uintBitsToFloat(floatBitsToUint(found.w) | 0x80000000u) : found.w;
    tiles[tile.y * tile_count().x + tile.x] = vec4(found.xyz, near_reach);
    atomicMax(wide[kWidestAt], floatBitsToUint(found.x));
    if (found.x >= least_wide()) {
      wide[kWideGroupsAt] = gl_NumWorkGroups.x;
    }
    within.y = found.x < frame.limits.x ? within.y : 0;
  }
  for (int row = 0; row < within.y; ++row) {
    int at = base + (corner.y + row) * frame.size.x + corner.x;
    for (int column = 0; column < within.x; ++column) {
      leave_sharp(at + column, texelFetch(pixels, at + column).xy);
    }
  }
}
