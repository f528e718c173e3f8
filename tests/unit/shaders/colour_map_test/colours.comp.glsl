// The colour map `which` at in[i].
#version 460
#include "render/image/gpu/colour_map.h"
layout(local_size_x = 64) in;
layout(set = 0, binding = 0, std430) readonly buffer In { float values[]; } source;
layout(set = 0, binding = 1, std430) writeonly buffer Out { vec4 values[]; } target;
layout(push_constant) uniform Push { int which; uint count; } push;

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i < push.count) target.values[i] = vec4(colour_map(push.which, source.values[i]), 1.0);
}
