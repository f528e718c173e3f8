#version 460
#extension GL_GOOGLE_include_directive : require
// One beam for each block of pixels: whether there may be more in it than its pixels' own rays show. Where those differ
// among themselves there is, and no beam is needed.
#define FOOTPRINT_PIXELS 4.25  // kBeamBlock, and a little where the lens bends the beam's sides
#include "render/shaders/scene_bindings.glsl"
#include "render/shaders/shading.glsl"
#include "render/shaders/pixel.glsl"
#include "render/shaders/beam.glsl"
#define SHOWN_TILES_AT 13
#include "render/shaders/group.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(std430, binding = 10) writeonly buffer Blocks { uint blocks[]; };
layout(binding = 11) uniform usamplerBuffer pixels;
layout(binding = 12) uniform usamplerBuffer keys;
#include "render/shaders/edge_test.glsl"

// Of listed tiles, of four blocks each, a group takes sixteen.
ivec2 block_in_picture() {
  if (kListedTiles == 0u) {
    return pixel_in_picture();
  }
  uint k = gl_LocalInvocationIndex;
  return ivec2(2u * shown_tile(16u * group_index() + k / 4u) + uvec2(k & 1u, (k >> 1) & 1u));
}

void main() {
  ivec2 size = frame.size.xy;
  ivec2 first = kBeamBlock * block_in_picture();
  if (first.x >= size.x || first.y >= size.y) {
    return;
  }
  int base = frame.view.x * size.x * size.y;
  int at = base + first.y * size.x + first.x;
  uvec2 key = texelFetch(keys, at).xy;
  float depth = uintBitsToFloat(texelFetch(pixels, at).w);
  bool more = false;
  for (int k = 1; k < kBeamBlock * kBeamBlock && !more; ++k) {
    ivec2 q = min(first + ivec2(k % kBeamBlock, k / kBeamBlock), size - 1);
    more = differs_in_shape(key, depth, base + q.y * size.x + q.x);
  }
  if (!more) {
    more = square_shows_more(view_data(frame.view.x), vec2(first) + 0.5 * float(kBeamBlock), key.x);
  }
  blocks[block_index(first)] = more ? 1u : 0u;
}
