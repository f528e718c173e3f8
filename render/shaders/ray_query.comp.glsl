#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_ray_query : require
// What each pixel's ray meets first, by the device's own ray query (VK_KHR_ray_query). The device names a triangle, by
// tests of its own; whether it holds for the ray is tested with the arithmetic of the per-ray traversal, else the pixel
// is left out (left_out.comp.glsl), so that pictures agree.
#include "render/shaders/scene_bindings.glsl"
#define SHOWN_TILES_AT 15
#include "render/shaders/group.glsl"
#include "render/shaders/list.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 10) uniform samplerBuffer ray_origins;  // as rays.comp.glsl leaves them
layout(binding = 11) uniform samplerBuffer ray_directions;
layout(std430, binding = 12) writeonly buffer Hits { uint hits[]; };
layout(std430, binding = 13) buffer LeftOut { uint left_out[]; };  // pixels to be traced one by one
layout(binding = 14) uniform accelerationStructureEXT accelerated;  // primitives in leaf order

void main() {
  ivec2 p = pixel_in_picture();
  if (p.x >= frame.size.x || p.y >= frame.size.y) {
    return;
  }
  int at = (frame.view.x * frame.size.y + p.y) * frame.size.x + p.x;
  vec4 direction = texelFetch(ray_directions, at);
  if (direction.w < 0.0) {
    hits[at] = kNoTriangle;
    return;
  }
  vec3 origin = texelFetch(ray_origins, at).xyz;
  // Without backs to leave out and holes to look through, every candidate is a hit.
  const uint ray_flags = HAS(kFeatureCull | kFeatureMask) ? gl_RayFlagsNoneEXT : gl_RayFlagsOpaqueEXT;
  rayQueryEXT query;
  rayQueryInitializeEXT(query, accelerated, ray_flags, 0xFFu, origin, 0.0, direction.xyz, kFarthest);
  while (rayQueryProceedEXT(query)) {
    uint triangle = uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, false));
    PlaneHit candidate = plane_hit(triangle, origin, direction.xyz);
    if (ray_meets(candidate.flags, candidate.determinant > 0.0, triangle, candidate.hit.material, candidate.hit.u,
                  candidate.hit.v)) {
      rayQueryConfirmIntersectionEXT(query);
    }
  }
  bool met = rayQueryGetIntersectionTypeEXT(query, true) == gl_RayQueryCommittedIntersectionTriangleEXT;
  uint found = met ? uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, true)) : kNoTriangle;
  hits[at] = found;
  if (met && !is_hit(plane_hit(found, origin, direction.xyz), kFarthest)) {
    APPEND(left_out, uint(at))
  }
}
