#version 460
#extension GL_GOOGLE_include_directive : require
// The picture that wide blurs gather from (frame.h), where there are any, in the tiles that they reach. An invocation for
// each tile.
#include "render/shaders/gather.glsl"

layout(std430, binding = 1) writeonly buffer Texels { uvec4 texels[]; };
layout(binding = 2) uniform usamplerBuffer wide;     // kWidestAt
layout(binding = 3) uniform usamplerBuffer sources;  // blur_reach

struct Mean {
  vec3 radiance;
  float count;
};

// A pixel, which is copied too.
Tap tap_or_none(ivec2 q) {
  ivec2 inside = min(q, frame.size.xy - 1);
  uvec4 packed = texelFetch(pixels, frame.view.x * frame.size.x * frame.size.y + inside.y * frame.size.x + inside.x);
  texels[q.y * blur_level_width(tile_count(), 0) + q.x] = packed;
  Tap tap = unpack_tap(packed);
  tap.depth = inside == q ? tap.depth : -1.0;
  return tap;
}

void leave_level(int level, ivec2 at, Mean mean) {
  vec3 radiance = mean.radiance / max(mean.count, 1.0);
  texels[blur_level_start(tile_count(), level) + at.y * blur_level_width(tile_count(), level) + at.x] =
      uvec4(packHalf2x16(radiance.rg), packHalf2x16(vec2(radiance.b, 0.0)), 0u,
            floatBitsToUint(mean.count > 0.0 ? 1.0 : -1.0));
}

// The mean of a square; beside it that of those of its pixels that share the nearest depth.
Mean leave_square(ivec2 corner, Tap taps[4]) {
  float front = -1.0;
  for (int k = 0; k < 4; ++k) {
    front = max(front, taps[k].depth < 0.0 ? -1.0 : nearness(taps[k].depth));
  }
  Mean all = Mean(vec3(0.0), 0.0);
  vec3 radiance = vec3(0.0);
  vec3 ellipse = vec3(0.0);
  float here = 0.0;
  float count = 0.0;
  for (int k = 0; k < 4; ++k) {
    if (taps[k].depth >= 0.0) {
      all.radiance += taps[k].radiance;
      all.count += 1.0;
      float w = (front - nearness(taps[k].depth)) * frame.limits.w > kBlurParallax ? 0.0 : 1.0;
      radiance += w * taps[k].radiance;
      ellipse += w * taps[k].ellipse;
      here += w * nearness(taps[k].depth);
      count += w;
    }
  }
  leave_level(1, corner / 2, all);
  float part = 1.0 / max(count, 1.0);
  ivec2 at = corner / 2;
  texels[blur_nearest_start(tile_count()) + at.y * blur_level_width(tile_count(), 1) + at.x] =
      pack_square(Square(part * radiance, 0.25 * count, part * ellipse, part * here));
  return all;
}

void main() {
  ivec2 tile = pixel_in_picture();
  if (any(greaterThanEqual(tile, tile_count()))) {
    return;
  }
  float most = kernel_reach() * uintBitsToFloat(texelFetch(wide, int(kWidestAt)).x);
  bool reached = all_are_sources(most) || texelFetch(sources, tile.y * tile_count().x + tile.x).x != 0u;
  int parts = reached ? 4 : 0;  // loops end early on a software device too
  Mean eight = Mean(vec3(0.0), 0.0);
  for (int four_at = 0; four_at < parts; ++four_at) {
    Mean four = Mean(vec3(0.0), 0.0);
    for (int two_at = 0; two_at < parts; ++two_at) {
      ivec2 corner = kBlurTile * tile + 4 * ivec2(four_at & 1, four_at >> 1) + 2 * ivec2(two_at & 1, two_at >> 1);
      Tap taps[4];
      for (int k = 0; k < 4; ++k) {
        taps[k] = tap_or_none(corner + ivec2(k & 1, k >> 1));
      }
      Mean two = leave_square(corner, taps);
      four = Mean(four.radiance + two.radiance, four.count + two.count);
    }
    leave_level(2, 2 * tile + ivec2(four_at & 1, four_at >> 1), four);
    eight = Mean(eight.radiance + four.radiance, eight.count + four.count);
  }
  if (reached) {
    leave_level(3, tile, eight);
  }
}
