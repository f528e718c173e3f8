#version 460
#extension GL_GOOGLE_include_directive : require
// Which tiles see depth within reach of a blur: those are listed, and get their layers apart. A tile looks at all that
// its own blur reaches and all whose blur reaches it.
#include "render/shaders/gather.glsl"

layout(binding = 1) uniform samplerBuffer tiles;
layout(std430, binding = 2) writeonly buffer Reach { float reaches[]; };  // px that what lies in front reaches into a listed tile; -1: not listed
layout(std430, binding = 3) buffer List { uint list[]; };

void main() {
  ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
  ivec2 count = tile_count();
  if (any(greaterThanEqual(tile, count))) {
    return;
  }
  vec4 own = texelFetch(tiles, tile.y * count.x + tile.x);
  float apart = kBlurParallax / frame.limits.w;  // D
  float nearest = own.y;
  float farthest = own.z;
  float reach = 0.0;
  for (int y = max(tile.y - kMostBlurTiles, 0); y <= min(tile.y + kMostBlurTiles, count.y - 1); ++y) {
    for (int x = max(tile.x - kMostBlurTiles, 0); x <= min(tile.x + kMostBlurTiles, count.x - 1); ++x) {
      vec4 other = texelFetch(tiles, y * count.x + x);
      float gap = float(kBlurTile * (max(abs(x - tile.x), abs(y - tile.y)) - 1));
      if (kernel_reach() * own.x > gap) {
        nearest = max(nearest, other.y);
        farthest = min(farthest, other.z);
      }
      if (kernel_reach() * other.w > gap && other.y - own.z > apart) {
        reach = max(reach, other.w);
      }
    }
  }
  reach = reach >= frame.limits.x ? min(reach * kernel_reach(), float(kBlurTile * kMostBlurTiles)) : 0.0;
  bool listed = reach > 0.0 || (own.x >= frame.limits.x && nearest - farthest > apart);
  reaches[tile.y * count.x + tile.x] = listed ? reach : -1.0;
  if (listed) {
    uint place = atomicAdd(list[kListCountAt], 1u);
    list[kListFirstAt + place] = uint(tile.y * count.x + tile.x);
    if (place < kListMostGroups) {
      atomicAdd(list[0], 1u);
    }
  }
}
