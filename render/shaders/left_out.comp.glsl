#version 460
#extension GL_GOOGLE_include_directive : require
// The rays that the tile traversal left out, one by one.
#include "render/shaders/scene_bindings.glsl"

layout(local_size_x = 64) in;
layout(binding = 10) uniform samplerBuffer ray_origins;
layout(binding = 11) uniform samplerBuffer ray_directions;
layout(std430, binding = 12) writeonly buffer Hits { uint hits[]; };
layout(std430, binding = 13) readonly buffer LeftOut { uint left_out[]; };

void main() {
  uint count = left_out[kListCountAt];
  for (uint i = gl_GlobalInvocationID.x; i < count; i += kListGroup * gl_NumWorkGroups.x) {
    int at = int(left_out[kListFirstAt + i]);
    Hit hit;
    bool met = trace_closest(texelFetch(ray_origins, at).xyz, texelFetch(ray_directions, at).xyz, kFarthest, hit);
    hits[at] = met ? hit.triangle : kNoTriangle;
  }
}
