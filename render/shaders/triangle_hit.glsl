// One ray against one triangle. The including shader declares uniform samplerBuffer bvh_triangles; within what GLM can
// compile as C++ too, as traverse_bvh4.glsl.
#ifndef VERGENCE_TRIANGLE_HIT_GLSL
#define VERGENCE_TRIANGLE_HIT_GLSL

#include "render/scene/gpu/bvh_layout.h"

struct Hit {
  float t;        // in lengths of the direction
  uint triangle;  // in leaf order; kNoTriangle for a miss
  uint material;
  float u, v;  // barycentric weights of corners 1 and 2
};

const float kFarthest = 1e30f;
const uint kNoTriangle = 0xFFFFFFFFu;

// Moeller and Trumbore, Fast, minimum storage ray-triangle intersection (1997): t, u and v in the triangle's plane,
// whether the ray passes inside or not.
Hit plane_hit(uint triangle, vec3 origin, vec3 direction) {
  int texel = int(triangle * kBvhTriangleTexels);
  vec4 corner = texelFetch(bvh_triangles, texel);
  vec3 e1 = vec3(texelFetch(bvh_triangles, texel + 1));
  vec3 e2 = vec3(texelFetch(bvh_triangles, texel + 2));
  vec3 p = cross(direction, e2);
  float determinant = dot(e1, p);
  float inverse = 1.0f / determinant;
  vec3 s = origin - vec3(corner);
  float u = dot(s, p) * inverse;
  vec3 q = cross(s, e1);
  float v = dot(direction, q) * inverse;
  float t = dot(e2, q) * inverse;
  return Hit(determinant != 0.0f ? t : -1.0f, triangle, floatBitsToUint(corner.w), u, v);
}

// Written so that a NaN fails. t = 0 is no hit: a ray that starts on a triangle does not see it.
bool is_hit(Hit hit, float t_max) {
  return hit.u >= 0.0f && hit.v >= 0.0f && hit.u + hit.v <= 1.0f && hit.t > 0.0f && hit.t < t_max;
}

Hit closer_hit(Hit best, uint triangle, vec3 origin, vec3 direction) {
  Hit hit = plane_hit(triangle, origin, direction);
  if (is_hit(hit, best.t)) {
    best = hit;
  }
  return best;
}

#endif
