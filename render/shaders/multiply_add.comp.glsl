#version 460
// Nothing but multiply-adds on 16 values a lane that do not wait for each other: what a device can compute at best.
layout(local_size_x = 64) in;
layout(std430, binding = 0) writeonly buffer Out { float result[]; };
layout(push_constant) uniform Push { uint steps; };

void main() {
  // Factors that the compiler cannot know, and that keep the values finite.
  float f = 1.0 - 1e-6 * float(steps);
  vec4 a = vec4(gl_GlobalInvocationID.x) + vec4(0.0, 1.0, 2.0, 3.0);
  vec4 b = a + 4.0, c = a + 8.0, d = a + 12.0;
  for (uint i = 0u; i < steps; ++i) {
    a = a * f + 0.5;
    b = b * f + 0.5;
    c = c * f + 0.5;
    d = d * f + 0.5;
  }
  vec4 sum = (a + b) + (c + d);
  result[gl_GlobalInvocationID.x] = (sum.x + sum.y) + (sum.z + sum.w);
}
