// out[i] = factor * in[i] + push.add, one invocation an element.
#version 460
layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint kFactor = 2;
layout(set = 0, binding = 0, std430) readonly buffer In { uint values[]; } source;
layout(set = 0, binding = 1, std430) writeonly buffer Out { uint values[]; } target;
layout(push_constant) uniform Push { uint count; uint add; } push;

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i < push.count) target.values[i] = kFactor * source.values[i] + push.add;
}
