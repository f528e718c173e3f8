#version 460
#extension GL_GOOGLE_include_directive : require
// The `trace` command's records with the very functions that the render kernels use.
layout(binding = 0) uniform samplerBuffer lens_table;
layout(constant_id = 0) const uint kSurfaceKinds = 0xffffffffu;
#define BACK_KINDS (kSurfaceKinds & 0xffffu)
#define FRONT_KINDS ((kSurfaceKinds >> 16) & 0x7fffu)
#define MAY_CROSS ((kSurfaceKinds >> 31) != 0u)
layout(constant_id = 1) const uint kLensIterations = 0u;
#define NEWTON_STEPS int(kLensIterations)
#include "lenses/gpu/optics.h"

layout(local_size_x = 64) in;
layout(std430, binding = 1) readonly buffer Lenses { LensData lenses[]; };
layout(std430, binding = 2) readonly buffer Eyes { EyeData eyes[]; };
layout(std430, binding = 3) readonly buffer Rays { TraceInput rays[]; };
layout(std430, binding = 4) writeonly buffer Results { TraceOutput results[]; };
layout(push_constant) uniform Count { uint ray_count; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= ray_count) {
    return;
  }
  TraceInput ray = rays[i];
  results[i] = trace_record(lenses[ray.which.x], eyes[ray.which.y], ray);
}
