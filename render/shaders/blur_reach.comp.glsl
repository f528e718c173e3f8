#version 460
#extension GL_GOOGLE_include_directive : require
// Which tiles see depth within reach of a blur: those are listed to get their layers apart; which of the others are
// blurred; which share gathers; and which have something that wide blurs gather. A tile looks at all that its own blur
// reaches and all whose blur reaches it.
#include "render/shaders/gather.glsl"

layout(binding = 1) uniform samplerBuffer tiles;
layout(std430, binding = 2) writeonly buffer Reach { vec2 reaches[]; };  // gather.glsl
layout(binding = 3) uniform usamplerBuffer wide;  // kWidestAt
layout(std430, binding = 4) buffer Layered { uint layered[]; };
layout(std430, binding = 5) buffer Blurred { uint blurred[]; };
layout(std430, binding = 6) buffer Narrow { uint narrow[]; };
layout(std430, binding = 8) buffer WideLayered { uint wide_layered[]; };
layout(std430, binding = 7) buffer Squared { uint squared[]; };
layout(std430, binding = 9) writeonly buffer Sources { uint sources[]; };  // 1: needs its part of the wide picture

// Appends to a list of tiles, of which a workgroup takes `at_once`: kListAcross workgroups, then a row more of them.
#define APPEND_TILE(list, item, at_once)             \
  {                                                  \
    uint place = atomicAdd(list[kListCountAt], 1u);  \
    list[kListFirstAt + place] = item;               \
    if (place % at_once == 0u) {                     \
      uint group = place / at_once;                  \
      if (group < kListAcross) {                     \
        atomicAdd(list[0], 1u);                      \
      } else if (group % kListAcross == 0u) {        \
        atomicAdd(list[1], 1u);                      \
      }                                              \
    }                                                \
  }

void mark_sources(ivec2 tile, int around) {
  ivec2 count = tile_count();
  ivec2 first = max(tile - around, ivec2(0));
  ivec2 last = around < 0 ? ivec2(-1) : min(tile + around, count - 1);
  for (int y = first.y; y <= last.y; ++y) {
    for (int x = first.x; x <= last.x; ++x) {
      sources[y * count.x + x] = 1u;
    }
  }
}

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
  float beside = 0.0;  // the largest blur of the tiles that touch this one
  float most = kernel_reach() * uintBitsToFloat(texelFetch(wide, int(kWidestAt)).x);
  int around = min(int(ceil(most / float(kBlurTile))), kMostBlurTiles);
  for (int y = max(tile.y - around, 0); y <= min(tile.y + around, count.y - 1); ++y) {
    for (int x = max(tile.x - around, 0); x <= min(tile.x + around, count.x - 1); ++x) {
      vec4 other = texelFetch(tiles, y * count.x + x);
      float gap = float(kBlurTile * (max(abs(x - tile.x), abs(y - tile.y)) - 1));
      beside = gap <= 0.0 ? max(beside, other.x) : beside;
      if (kernel_reach() * own.x > gap) {
        nearest = max(nearest, other.y);
        farthest = min(farthest, other.z);
      }
      if (kernel_reach() * other.w > gap && other.y - own.z > apart) {
        reach = max(reach, other.w);
        nearest = max(nearest, other.y);
      }
    }
  }
  reach = reach >= frame.limits.x ? min(reach * kernel_reach(), float(kBlurTile * kMostBlurTiles)) : 0.0;
  bool listed = reach > 0.0 || (own.x >= frame.limits.x && nearest - farthest > apart);
  reaches[tile.y * count.x + tile.x] = vec2(listed ? reach : -1.0, nearest);
  uint item = pack_tile(tile);
  float farthest_gathered = max(kernel_reach() * own.x, reach);
  bool wide_gathers = (listed ? farthest_gathered : kernel_reach() * own.x) >= kernel_reach() * least_wide();
  if (listed) {
    if (wide_gathers) {
      APPEND_TILE(wide_layered, item, 1u)
    } else {
      APPEND_TILE(layered, item, 1u)
    }
  } else if (own.x >= least_wide()) {
    APPEND_TILE(blurred, item, 1u)
  } else if (own.x >= frame.limits.x) {
    APPEND_TILE(narrow, item, kNarrowTiles)
  }
  bool shares = kRate > 1 && beside >= kWideBlur;
  if (shares) {
    APPEND_TILE(squared, item, kSquaredTiles)
  }
  if (!all_are_sources(most)) {
    mark_sources(tile, wide_gathers ? tiles_gathered(farthest_gathered) : (shares ? 0 : -1));
  }
}
