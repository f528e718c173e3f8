#version 460
// What nobody sees of a picture: black, and nothing that a blur could gather from.

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform usamplerBuffer hidden_tiles;  // render/shown_tiles.hpp
layout(std430, binding = 1) writeonly buffer Pixels { uvec4 pixels[]; };
layout(std430, binding = 2) writeonly buffer Keys { uvec2 keys[]; };
layout(std430, binding = 3) writeonly buffer Radiance { uvec2 radiance[]; };
layout(std430, binding = 4) writeonly buffer Display { uint display[]; };
layout(push_constant) uniform Which { ivec4 which; };  // width, height, view, -

void main() {
  uint tile = texelFetch(hidden_tiles, int(gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x)).x;
  ivec2 p = ivec2(uvec2(tile & 0xffffu, tile >> 16) * 8u + gl_LocalInvocationID.xy);
  if (p.x >= which.x || p.y >= which.y) {
    return;
  }
  int at = (which.z * which.y + p.y) * which.x + p.x;
  pixels[at] = uvec4(0u, 0u, 0u, floatBitsToUint(-1.0));
  keys[at] = uvec2(0u);
  radiance[at] = uvec2(0u);
  display[at] = 0xff000000u;
}
