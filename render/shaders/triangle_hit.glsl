// One ray against one triangle. The including shader declares uniform samplerBuffer bvh_triangles; within what GLM can
// compile as C++ too, as traverse_bvh4.glsl.
#ifndef VERGENCE_TRIANGLE_HIT_GLSL
#define VERGENCE_TRIANGLE_HIT_GLSL

#include "render/scene/gpu/bvh_layout.h"

// Whether a triangle that the ray's line crosses counts; flags are kBvhCulled and its fellows.
#ifndef VERGENCE_MEETS
#define VERGENCE_MEETS(flags, front, triangle, material, u, v) true
#endif

struct Hit {
  float t;        // in lengths of the direction
  uint triangle;  // in leaf order; kNoTriangle for a miss
  uint material;
  float u, v;  // barycentric weights of corners 1 and 2
};

const float kFarthest = 1e30f;
const uint kNoTriangle = 0xFFFFFFFFu;

// Where a ray's line crosses a triangle's plane, inside the triangle or not.
struct PlaneHit {
  Hit hit;
  uint flags;
  float determinant;  // > 0: the ray meets the front; 0: it runs along the plane
};

// Moeller and Trumbore, Fast, minimum storage ray-triangle intersection (1997).
PlaneHit plane_hit(uint triangle, vec3 origin, vec3 direction) {
  int texel = int(triangle * kBvhTriangleTexels);
  vec4 corner = texelFetch(bvh_triangles, texel);
  vec3 e1 = vec3(texelFetch(bvh_triangles, texel + 1));
  vec4 last = texelFetch(bvh_triangles, texel + 2);
  vec3 e2 = vec3(last);
  vec3 p = cross(direction, e2);
  float determinant = dot(e1, p);
  float inverse = 1.0f / determinant;
  vec3 s = origin - vec3(corner);
  float u = dot(s, p) * inverse;
  vec3 q = cross(s, e1);
  float v = dot(direction, q) * inverse;
  float t = dot(e2, q) * inverse;
  return PlaneHit(Hit(t, triangle, floatBitsToUint(corner.w), u, v), floatBitsToUint(last.w), determinant);
}

// Every condition is written so that a NaN fails it. t = 0 is no hit: a ray that starts on a triangle does not see it.
bool is_hit(PlaneHit at, float t_max) {
  return at.determinant != 0.0f && at.hit.u >= 0.0f && at.hit.v >= 0.0f && at.hit.u + at.hit.v <= 1.0f &&
         at.hit.t > 0.0f && at.hit.t < t_max;
}

Hit closer_hit(Hit best, uint triangle, vec3 origin, vec3 direction) {
  PlaneHit at = plane_hit(triangle, origin, direction);
  if (is_hit(at, best.t)) {
    if (VERGENCE_MEETS(at.flags, at.determinant > 0.0f, triangle, at.hit.material, at.hit.u, at.hit.v)) {
      best = at.hit;
    }
  }
  return best;
}

#endif
