// Rays against the 4-wide quantised BVH, one ray an invocation. The including shader declares
//   uniform usamplerBuffer bvh_nodes; uniform samplerBuffer bvh_triangles;
// and render/scene/gpu/bvh_layout.h says what they hold. The core below stays within what GLM can compile as C++ too
// (no swizzles, no out parameters): the tests run this very text against Embree.
#ifndef VERGENCE_TRAVERSE_BVH4_GLSL
#define VERGENCE_TRAVERSE_BVH4_GLSL

#include "render/shaders/triangle_hit.glsl"

const uint kTraversalDone = 0xFFFFFFFEu;
// No sound tree makes a ray take this many steps; a broken buffer must not hang the device.
const int kMaxTraversalSteps = 1 << 20;

// 1 / d, kept finite: with positions below 1e9 m and box margins of a nanometre every product below stays finite, and a
// ray inside a slab it runs parallel to leaves the slab beyond everything.
float slab_inverse(float d) {
  float smallest = d < 0.0f ? -1e-20f : 1e-20f;
  return 1.0f / (abs(d) < 1e-20f ? smallest : d);
}

// Finite, and not so large that squares overflow. Looks at the bits because shader compilers may assume that no NaN
// occurs.
bool is_sound(vec3 origin, vec3 direction) {
  float squares = dot(origin, origin) + dot(direction, direction);
  return (floatBitsToUint(squares) & 0x7F800000u) != 0x7F800000u && dot(direction, direction) > 0.0f;
}

vec4 unpack_bytes(uint q) {
  return vec4(float(q & 255u), float((q >> 8) & 255u), float((q >> 16) & 255u), float(q >> 24));
}

#define VERGENCE_ORDER(a, b)                                  \
  {                                                           \
    bool swap_them = entry.b < entry.a;                       \
    int nearer = swap_them ? entry.b : entry.a;               \
    entry.b = swap_them ? entry.a : entry.b;                  \
    entry.a = nearer;                                         \
    uint nearer_child = swap_them ? child.b : child.a;        \
    child.b = swap_them ? child.a : child.b;                  \
    child.a = nearer_child;                                   \
  }

// The closest hit with 0 < t < t_max, or with any_hit the first one found. Slabs are compared as integers: for floats
// >= 0 the order of the bits is the order of the values, negative ones only have to stay negative, and integer min and
// max are single instructions where the float ones are not.
Hit traverse_bvh4(vec3 origin, vec3 direction, float t_max, bool any_hit) {
  Hit best = Hit(t_max < kFarthest ? t_max : kFarthest, kNoTriangle, 0u, 0.0f, 0.0f);
  if (!is_sound(origin, direction) || !(t_max > 0.0f)) return best;
  const int kMissed = 0x7FFFFFFF;
  vec3 inverse = vec3(slab_inverse(direction.x), slab_inverse(direction.y), slab_inverse(direction.z));
  uint stack[kBvhStackSize];
  int top = 0;
  uint current = 0u;
  int steps = 0;
  // Loops ask at their end: on a software device one that asks at its start runs once more for nothing.
  do {
    do {
      if (current < kBvhLeafBit) {
        ++steps;
        int texel = int(current * kBvhNodeTexels);
        uvec4 q0 = texelFetch(bvh_nodes, texel);
        uvec4 q1 = texelFetch(bvh_nodes, texel + 1);
        uvec4 q2 = texelFetch(bvh_nodes, texel + 2);
        uvec4 child = texelFetch(bvh_nodes, texel + 3);
        vec3 start = (vec3(uintBitsToFloat(q0.x), uintBitsToFloat(q0.y), uintBitsToFloat(q0.z)) - origin) * inverse;
        vec3 scale = vec3(uintBitsToFloat(q0.w), uintBitsToFloat(q1.x), uintBitsToFloat(q1.y)) * inverse;
        ivec4 x0 = floatBitsToInt(unpack_bytes(q1.z) * scale.x + start.x);
        ivec4 x1 = floatBitsToInt(unpack_bytes(q1.w) * scale.x + start.x);
        ivec4 y0 = floatBitsToInt(unpack_bytes(q2.x) * scale.y + start.y);
        ivec4 y1 = floatBitsToInt(unpack_bytes(q2.y) * scale.y + start.y);
        ivec4 z0 = floatBitsToInt(unpack_bytes(q2.z) * scale.z + start.z);
        ivec4 z1 = floatBitsToInt(unpack_bytes(q2.w) * scale.z + start.z);
        ivec4 entry = max(max(min(x0, x1), min(y0, y1)), max(min(z0, z1), ivec4(0)));
        ivec4 leave = min(min(max(x0, x1), max(y0, y1)), min(max(z0, z1), ivec4(floatBitsToInt(best.t))));
        // Entry and exit carry five roundings each; 16 units in the last place cover both (as in Ize, Robust BVH ray
        // traversal, 2013).
        leave = leave + ivec4(16);
        entry.x = entry.x <= leave.x && child.x != kBvhNoChild ? entry.x : kMissed;
        entry.y = entry.y <= leave.y && child.y != kBvhNoChild ? entry.y : kMissed;
        entry.z = entry.z <= leave.z && child.z != kBvhNoChild ? entry.z : kMissed;
        entry.w = entry.w <= leave.w && child.w != kBvhNoChild ? entry.w : kMissed;
        VERGENCE_ORDER(x, y)
        VERGENCE_ORDER(z, w)
        VERGENCE_ORDER(x, z)
        VERGENCE_ORDER(y, w)
        VERGENCE_ORDER(y, z)
        // The builder bounds the depth so that this fits. What is missed is overwritten: a branch would run both sides.
        stack[top] = child.w;
        top += entry.w != kMissed ? 1 : 0;
        stack[top] = child.z;
        top += entry.z != kMissed ? 1 : 0;
        stack[top] = child.y;
        top += entry.y != kMissed ? 1 : 0;
        bool goes_down = entry.x != kMissed;
        bool goes_on = !goes_down && top > 0;
        top -= goes_on ? 1 : 0;
        current = goes_down ? child.x : (goes_on ? stack[top] : kTraversalDone);
      }
    } while (current < kBvhLeafBit && steps < kMaxTraversalSteps);
    do {
      if (current >= kBvhLeafBit && current != kTraversalDone) {
        uint first = (current >> kBvhLeafFirstShift) & kBvhLeafFirstMask;
        uint count = current & kBvhLeafCountMask;
        uint i = 0u;
        do {
          best = closer_hit(best, first + i, origin, direction);
          ++i;
        } while (i < count);
        current = top > 0 ? stack[--top] : kTraversalDone;
        if (any_hit && best.triangle != kNoTriangle) current = kTraversalDone;
      }
    } while (current >= kBvhLeafBit && current != kTraversalDone);
  } while (current != kTraversalDone && steps < kMaxTraversalSteps);
  return best;
}
#ifdef __cplusplus
#undef VERGENCE_ORDER
#else
bool trace_closest(vec3 origin, vec3 direction, float t_max, out Hit hit) {
  hit = traverse_bvh4(origin, direction, t_max, false);
  return hit.triangle != kNoTriangle;
}

// Whether anything lies between the origin and t_max: shadow rays.
bool trace_any(vec3 origin, vec3 direction, float t_max) {
  return traverse_bvh4(origin, direction, t_max, true).triangle != kNoTriangle;
}
#endif

#endif
