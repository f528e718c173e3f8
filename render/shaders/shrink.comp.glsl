#version 460
#extension GL_GOOGLE_include_directive : require
// A block of display bytes into its place in a smaller copy of the picture: each pixel of the copy is the mean of those
// it stands for, of the encoded values, as a blit of the bytes would have it.
#include "render/shaders/shrink.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(std430, binding = 0) readonly buffer From { uint from[]; };
layout(std430, binding = 1) writeonly buffer To { uint to[]; };
layout(push_constant) uniform Push { ShrinkBlock block; };

void main() {
  ivec2 within = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(within, block.target.zw))) {
    return;
  }
  ivec2 p = block.target.xy + within;
  ivec2 low = p * block.sizes.xy / block.sizes.zw;
  ivec2 high = max(low + 1, (p + 1) * block.sizes.xy / block.sizes.zw);
  low = clamp(low - block.place.xy, ivec2(0), block.place.zw - 1);
  high = min(high - block.place.xy, block.place.zw);
  uvec4 sum = uvec4(0u);
  for (int y = low.y; y < high.y; ++y) {
    for (int x = low.x; x < high.x; ++x) {
      uint c = from[block.source.x + y * block.source.y + x];
      sum += uvec4(c & 255u, (c >> 8) & 255u, (c >> 16) & 255u, 1u);
    }
  }
  uvec3 mean = (sum.xyz + sum.w / 2u) / max(sum.w, 1u);
  mean = block.source.z != 0 ? mean.zyx : mean;
  to[p.y * block.sizes.z + p.x] = mean.x | (mean.y << 8) | (mean.z << 16) | 0xff000000u;
}
