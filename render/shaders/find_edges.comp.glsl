#version 460
#extension GL_GOOGLE_include_directive : require
// Lists the pixels at an edge. Those beside another face, or whose block has more in it (beam_blocks.comp.glsl), are left
// to beams.comp.glsl; a jump of radiance on one face, or the end of a lens, is for rays alone to tell.
#include "render/shaders/frame.h"
#include "render/shaders/list.glsl"
#include "render/shaders/edge_items.glsl"

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
  bool rim = false;
  bool lit = false;
  bool face = false;
  // A straight edge through the pixel's square has centres of its neighbours on either side.
  for (int k = 0; k < 9; ++k) {
    ivec2 q = clamp(p + ivec2(k % 3 - 1, k / 3 - 1), ivec2(0), size - 1);
    int beside = base + q.y * size.x + q.x;
    bool other = differs_in_shape(key, depth, beside);
    face = face || other;
    rim = rim || differs_in_status(key, beside);
    lit = lit || (!other && differs_in_light(key, beside));
  }
  if (!rim && (face || texelFetch(blocks, block_index(p)).x != 0u)) {
    APPEND(doubtful, uint(at) | (lit ? kListLit : 0u) | (face ? 0u : kListThin))
  } else if (lit || rim) {
    APPEND(edges, uint(at))
  }
}
