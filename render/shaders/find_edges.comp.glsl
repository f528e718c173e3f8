#version 460
#extension GL_GOOGLE_include_directive : require
// Lists the pixels at an edge: another material, face, status, depth or a jump of radiance beside them.
#include "render/shaders/frame.h"
#include "render/shaders/list.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform usamplerBuffer pixels;
layout(binding = 1) uniform usamplerBuffer keys;
layout(std430, binding = 2) buffer Edges { uint edges[]; };
layout(push_constant) uniform Frame { FrameData frame; };

bool differs(uvec2 key, float depth, int at) {
  uvec2 other = texelFetch(keys, at).xy;
  uint change = other.x ^ key.x;
  if ((change & 0xffffu) != 0u) {
    return true;
  }
  if (change != 0u) {
    ivec3 a = ivec3((uvec3(key.x) >> uvec3(16u, 21u, 26u)) & 31u);
    ivec3 b = ivec3((uvec3(other.x) >> uvec3(16u, 21u, 26u)) & 31u);
    ivec3 d = abs(a - b);
    if (d.x + d.y + d.z > 6) {
      return true;
    }
  }
  // Shadows and textures have edges too: a jump of more than an eighth.
  float luminance = uintBitsToFloat(key.y);
  float other_luminance = uintBitsToFloat(other.y);
  if (abs(other_luminance - luminance) > 0.125 * max(luminance, other_luminance) + 0.002) {
    return true;
  }
  float other_depth = uintBitsToFloat(texelFetch(pixels, at).w);
  return abs(other_depth - depth) > 0.05 * max(max(depth, other_depth), 0.0);
}

void main() {
  ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  ivec2 size = frame.size.xy;
  if (p.x >= size.x || p.y >= size.y) {
    return;
  }
  int base = frame.view.x * size.x * size.y;
  int at = base + p.y * size.x + p.x;
  uvec2 key = texelFetch(keys, at).xy;
  float depth = uintBitsToFloat(texelFetch(pixels, at).w);
  bool edge = false;
  // Two pixels around, because a stroke thinner than a pixel may hide between the centres of the nearest ones.
  for (int k = 0; k < 25 && !edge; ++k) {
    ivec2 q = clamp(p + ivec2(k % 5 - 2, k / 5 - 2), ivec2(0), size - 1);
    edge = differs(key, depth, base + q.y * size.x + q.x);
  }
  if (edge) {
    APPEND(edges, uint(at))
  }
}
