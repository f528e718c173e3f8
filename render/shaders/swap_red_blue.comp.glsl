#version 460
// Display bytes with blue first, for images that want them so.

layout(local_size_x = 64) in;
layout(std430, binding = 0) buffer Display { uint display[]; };
layout(push_constant) uniform Count { uint pixels; };

void main() {
  uint i = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * 64u + gl_GlobalInvocationID.x;
  if (i < pixels) {
    uint c = display[i];
    display[i] = (c & 0xff00ff00u) | ((c & 0xffu) << 16) | ((c >> 16) & 0xffu);
  }
}
