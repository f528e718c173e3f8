#version 460
#extension GL_GOOGLE_include_directive : require
// What wide blurs gather from, where there are any: means over squares of 2, 4 and 8 pixels; and, of squares of 2
// pixels, the mean of what lies nearest. An invocation for each tile.
#include "render/shaders/gather.glsl"

layout(std430, binding = 1) writeonly buffer Levels { uvec2 levels[]; };
layout(std430, binding = 2) writeonly buffer Nearest { uvec4 nearest_squares[]; };

struct Mean {
  vec3 radiance;
  float count;
};

Tap tap_or_none(ivec2 q) {
  ivec2 inside = min(q, frame.size.xy - 1);
  Tap tap = tap_at(frame.view.x * frame.size.x * frame.size.y + inside.y * frame.size.x + inside.x);
  tap.depth = inside == q ? tap.depth : -1.0;
  return tap;
}

void leave_level(int level, ivec2 at, Mean mean) {
  vec3 radiance = mean.radiance / max(mean.count, 1.0);
  levels[blur_level_start(tile_count(), level) + at.y * blur_level_width(tile_count(), level) + at.x] =
      uvec2(packHalf2x16(radiance.rg), packHalf2x16(vec2(radiance.b, mean.count > 0.0 ? 1.0 : 0.0)));
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
  nearest_squares[at.y * blur_level_width(tile_count(), 1) + at.x] =
      pack_square(Square(part * radiance, 0.25 * count, part * ellipse, part * here));
  return all;
}

void main() {
  ivec2 tile = pixel_in_picture();
  if (any(greaterThanEqual(tile, tile_count()))) {
    return;
  }
  Mean eight = Mean(vec3(0.0), 0.0);
  for (int four_at = 0; four_at < 4; ++four_at) {
    Mean four = Mean(vec3(0.0), 0.0);
    for (int two_at = 0; two_at < 4; ++two_at) {
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
  leave_level(3, tile, eight);
}
