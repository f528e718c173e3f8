#version 460
#extension GL_GOOGLE_include_directive : require
// Lists the pixels at an edge: another material, face, status, depth or a jump of radiance beside them. Of the others,
// those whose block has more in it (beam_blocks.comp.glsl) are left to beams.comp.glsl.
#include "render/shaders/frame.h"
#include "render/shaders/list.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform usamplerBuffer pixels;
layout(binding = 1) uniform usamplerBuffer keys;
layout(binding = 2) uniform usamplerBuffer blocks;
layout(std430, binding = 3) buffer Edges { uint edges[]; };
layout(std430, binding = 4) buffer Doubtful { uint doubtful[]; };
layout(push_constant) uniform Frame { FrameData frame; };
#define SHOWN_TILES_AT 5
#include "render/shaders/group.glsl"
#include "render/shaders/edge_test.glsl"

void main() {
  ivec2 p = pixel_in_picture();
  ivec2 size = frame.size.xy;
  if (p.x >= size.x || p.y >= size.y) {
    return;
  }
  int base = frame.view.x * size.x * size.y;
  int at = base + p.y * size.x + p.x;
  uvec2 key = texelFetch(keys, at).xy;
  float depth = uintBitsToFloat(texelFetch(pixels, at).w);
  bool edge = false;
  // A straight edge through the pixel's square has centres of its neighbours on either side.
  for (int k = 0; k < 9 && !edge; ++k) {
    ivec2 q = clamp(p + ivec2(k % 3 - 1, k / 3 - 1), ivec2(0), size - 1);
    int beside = base + q.y * size.x + q.x;
    edge = differs_in_shape(key, depth, beside) || differs_in_light(key, beside);
  }
  if (edge) {
    APPEND(edges, uint(at))
  } else if (texelFetch(blocks, block_index(p)).x != 0u) {
    APPEND(doubtful, uint(at))
  }
}
