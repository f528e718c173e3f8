#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_shuffle : require
#extension GL_EXT_control_flow_attributes : require
// The closest triangle to each of a tile's 8 x 8 rays, found for the whole tile at once: one subgroup walks the 8-wide
// tree, each invocation testing one child against bounds that hold all rays of the tile, then one triangle of a leaf;
// what survives is tested against the rays of each half of the tile that it may reach. After the frustum traversal of Reshetov, Soupikov and Hurley,
// Multi-level ray tracing algorithm (2005).
//
// Along the tile's main axis w a ray is u = u0 + s_u w, v = v0 + s_v w, so that the bounds are eight numbers, whether
// the rays share an origin or not (those that left a lens do not). A tile whose rays do not all run forward along one
// axis is left out: its pixels are traced one by one (left_out.comp.glsl). Bounds are wider than rounding; a triangle that they keep out is
// hit by no ray.
#include "render/shaders/frame.h"
#include "render/shaders/list.glsl"

layout(constant_id = 0) const uint kLanes = 8u;  // of a subgroup: 8, 16, 32 or 64
layout(constant_id = 1) const uint kSceneFeatures = 0xffffffffu;  // kFeature... of view.h
#define HAS(features) ((kSceneFeatures & uint(features)) != 0u)
layout(local_size_x_id = 0) in;
layout(binding = 2) uniform usamplerBuffer wide_nodes;
layout(binding = 3) uniform samplerBuffer bvh_triangles;
layout(std430, binding = 4) writeonly buffer Hits { uint hits[]; };
layout(std430, binding = 5) buffer LeftOut { uint left_out[]; };  // pixels to be traced one by one
layout(push_constant) uniform Frame { FrameData frame; };
// CUBIC_RAYS: of smooth tiles alone, whose rays are cubics between corners.
#ifdef CUBIC_RAYS
layout(binding = 0) uniform samplerBuffer corners;
layout(binding = 1) uniform usamplerBuffer is_smooth;
layout(binding = 6) uniform usamplerBuffer view_words;
layout(std430, binding = 7) writeonly buffer Origins { vec4 origins[]; };  // of what is left out
layout(std430, binding = 8) writeonly buffer Directions { vec4 directions_out[]; };
#define SHOWN_TILES_AT 9
#else
layout(binding = 0) uniform samplerBuffer ray_origins;
layout(binding = 1) uniform samplerBuffer ray_directions;
#define SHOWN_TILES_AT 6
#endif
#include "render/shaders/group.glsl"

#include "render/shaders/triangle_hit.glsl"
#include "render/shaders/features.h"

const uint kTileSide = 8u;
const uint kRays = kTileSide * kTileSide / kLanes;  // of one invocation
// A triangle is tested against half a tile at a time: small ones seldom reach both. (Quarters gain as much in rays as
// they cost in bounds.)
const uint kParts = kRays > 1u ? 2u : 1u;
const uint kPartRays = kRays / kParts;
const uint kLastPart = kParts - 1u;
// In registers, kLanes entries each: a software device reads and writes shared memory lane by lane.
const uint kStackSlots = kLanes < 64u ? 64u / kLanes : 1u;
const uint kDone = 0xFFFFFFFEu;
const uint kHitBit = 0x80000000u;  // the sign of a distance, which has none
const uint kNoKey = 0xFFFFFFFFu;
const float kFar = 1e30;
// The least cosine between a ray and the main axis; slopes stay below 8.
const float kForward = 0.12;
// Relative, some eight units in the last place: covers the subtraction of the tile's origin and the slopes' products.
const float kSlack = 1e-6;

// References; entry p lies in lane p % kLanes of slot p / kLanes. Entry 0 is kDone.
struct Stack {
  uint slot[kStackSlots];
  uint size;
  uint top;  // the entry size - 1
};

// One instruction each on a software device, where min() and max() are three.
float least(float a, float b) { return a < b ? a : b; }
float most(float a, float b) { return a > b ? a : b; }
float sum(float a, float b) { return a + b; }
uint either(uint a, uint b) { return a | b; }
uint plus(uint a, uint b) { return a + b; }
uint least(uint a, uint b) { return min(a, b); }

// On a software device a shuffle costs less than a broadcast, and three of them less than a reduction.
#define OF_LANE(x, j) subgroupShuffle(x, j)
#define OVER_LANES(type, name, of_two, of_all)                  \
  type name(type x) {                                           \
    if (kLanes != 8u) {                                         \
      return of_all(x);                                         \
    }                                                           \
    x = of_two(x, OF_LANE(x, gl_SubgroupInvocationID ^ 1u));    \
    x = of_two(x, OF_LANE(x, gl_SubgroupInvocationID ^ 2u));    \
    return of_two(x, OF_LANE(x, gl_SubgroupInvocationID ^ 4u)); \
  }
OVER_LANES(float, smallest, least, subgroupMin)
OVER_LANES(float, largest, most, subgroupMax)
OVER_LANES(float, total, sum, subgroupAdd)
OVER_LANES(uint, all_bits, either, subgroupOr)
OVER_LANES(uint, total, plus, subgroupAdd)
OVER_LANES(uint, smallest, least, subgroupMin)
vec3 smallest(vec3 x) { return vec3(smallest(x.x), smallest(x.y), smallest(x.z)); }
vec3 largest(vec3 x) { return vec3(largest(x.x), largest(x.y), largest(x.z)); }
vec3 total(vec3 x) { return vec3(total(x.x), total(x.y), total(x.z)); }

// Bounds of rays: s_u, s_v, u0, v0.
struct Bounds {
  vec4 low;
  vec4 high;
};

Bounds joined(Bounds a, Bounds b) {
  return Bounds(vec4(least(a.low.x, b.low.x), least(a.low.y, b.low.y), least(a.low.z, b.low.z), least(a.low.w, b.low.w)),
                vec4(most(a.high.x, b.high.x), most(a.high.y, b.high.y), most(a.high.z, b.high.z),
                     most(a.high.w, b.high.w)));
}

void read_top(inout Stack stack) {
  uint at = stack.size - 1u;
  uint top = stack.slot[0];
  [[unroll]] for (uint i = 1u; i < kStackSlots; ++i) {
    top = at / kLanes == i ? stack.slot[i] : top;
  }
  stack.top = OF_LANE(top, at % kLanes);
}

// Of two lanes `step` apart, in runs of `run` lanes, turn by turn the smaller in front of the greater and behind it.
uint exchanged(uint key, uint run, uint step) {
  uint lane = gl_SubgroupInvocationID;
  uint other = OF_LANE(key, lane ^ step);
  return ((lane & step) == 0u) == ((lane & run) == 0u) ? max(key, other) : min(key, other);
}

// Of eight lanes' keys the i-th greatest in lane i: Batcher's bitonic network.
uint sorted(uint key) {
  key = exchanged(key, 2u, 1u);
  key = exchanged(exchanged(key, 4u, 2u), 4u, 1u);
  return exchanged(exchanged(exchanged(key, 8u, 4u), 8u, 2u), 8u, 1u);
}

int pixel_of(uint ray) {
  uint k = gl_SubgroupInvocationID + kLanes * ray;
  ivec2 p = ivec2(group_in_picture() * kTileSide + uvec2(k % kTileSide, k / kTileSide));
  bool outside = p.x >= frame.size.x || p.y >= frame.size.y;
  return outside ? -1 : (frame.view.x * frame.size.y + p.y) * frame.size.x + p.x;
}

// Where a tile's rays come from.
#ifdef CUBIC_RAYS
#include "render/shaders/tile_cubics.glsl"
#include "render/shaders/view_texels.h"

struct GivenRays {
  bool is_drawn;
  ColumnRays rays;
};

vec4 world_column(int i) { return uintBitsToFloat(texelFetch(view_words, kViewTexels * frame.view.x + kViewWorldAt + i)); }

GivenRays given_rays() {
  ivec2 tile = ivec2(group_in_picture());
  return GivenRays(tile_is_smooth(is_smooth, tile),
                   column_rays(tile_corners(tile), world_column(0), world_column(1), world_column(2)));
}

// w < 0: there is none.
vec4 given_direction(GivenRays given, uint ray, int at) {
  return vec4(cubic_direction(given.rays, int(ray)), given.is_drawn ? 1.0 : -1.0);
}

vec3 given_origin(GivenRays given, uint ray, int at) { return cubic_origin(given.rays, int(ray)); }

void keep_ray(int at, vec3 origin, vec4 direction) {
  origins[at] = vec4(origin, 0.0);
  directions_out[at] = direction;
}
#else
struct GivenRays {
  bool is_drawn;
};

GivenRays given_rays() { return GivenRays(true); }
vec4 given_direction(GivenRays given, uint ray, int at) { return texelFetch(ray_directions, max(at, 0)); }
vec3 given_origin(GivenRays given, uint ray, int at) { return texelFetch(ray_origins, max(at, 0)).xyz; }
void keep_ray(int at, vec3 origin, vec4 direction) {}
#endif

// A macro, because a loop around the loop would not be unrolled, and then the rays would be looked up by an index.
#define TEST_PART(part)                                                                                              \
  {                                                                                                                  \
    uint here = (survivors >> (8u * part)) & 255u;                                                                   \
    do {                                                                                                             \
      uint j = uint(findLSB(here)) & 7u;                                                                             \
      float nowhere = here == 0u ? -kFar : 0.0;                                                                      \
      here &= here - 1u;                                                                                             \
      vec4 plane = vec4(OF_LANE(n.x, j), OF_LANE(n.y, j), OF_LANE(n.z, j), OF_LANE(dn, j));                          \
      vec4 weight_p = vec4(OF_LANE(p.x, j), OF_LANE(p.y, j), OF_LANE(p.z, j), OF_LANE(dp, j) + nowhere);             \
      vec4 weight_q = vec4(OF_LANE(q.x, j), OF_LANE(q.y, j), OF_LANE(q.z, j), OF_LANE(dq, j));                       \
      [[unroll]] for (uint i = 0u; i < kPartRays; ++i) {                                                             \
        uint r = part * kPartRays + i;                                                                               \
        float against = plane.x * su[r] + plane.y * sv[r] + plane.z;                                                 \
        float w = (plane.w - (plane.x * u0[r] + plane.y * v0[r])) / against;                                         \
        float x = u0[r] + w * su[r];                                                                                 \
        float y = v0[r] + w * sv[r];                                                                                 \
        float k = weight_p.x * x + weight_p.y * y + weight_p.z * w + weight_p.w;                                     \
        float l = weight_q.x * x + weight_q.y * y + weight_q.z * w + weight_q.w;                                     \
        bool hit = k >= 0.0 && l >= 0.0 && k + l <= 1.0 && w > 0.0 && w < t[r];                                      \
        t[r] = hit ? w : t[r];                                                                                       \
        found[r] = hit ? first + j : found[r];                                                                       \
      }                                                                                                              \
    } while (here != 0u);                                                                                            \
  }

void main() {
  uint lane = gl_SubgroupInvocationID;
  vec3 ahead = vec3(0.0);
  vec3 low = vec3(kFar);
  vec3 high = vec3(-kFar);
  vec3 starts[kRays];
  vec4 directions[kRays];
  GivenRays given = given_rays();
  [[unroll]] for (uint r = 0u; r < kRays; ++r) {
    int at = pixel_of(r);
    vec4 d = given_direction(given, r, at);
    vec3 o = given_origin(given, r, at);
    d.w = at >= 0 ? d.w : -1.0;
    starts[r] = o;
    directions[r] = d;
    bool goes_on = d.w >= 0.0;
    ahead += goes_on ? d.xyz : vec3(0.0);
    low = vec3(goes_on && o.x < low.x ? o.x : low.x, goes_on && o.y < low.y ? o.y : low.y, goes_on && o.z < low.z ? o.z : low.z);
    high = vec3(goes_on && o.x > high.x ? o.x : high.x, goes_on && o.y > high.y ? o.y : high.y, goes_on && o.z > high.z ? o.z : high.z);
  }
  ahead = total(ahead);
  low = smallest(low);
  high = largest(high);
  vec3 size = abs(ahead);
  bool along_x = size.x >= size.y && size.x >= size.z;
  bool along_y = !along_x && size.y >= size.z;
#define IN_TILE(v) (along_x ? (v).yzx : along_y ? (v).zxy : (v).xyz)
  float forward = (along_x ? ahead.x : along_y ? ahead.y : ahead.z) < 0.0 ? -1.0 : 1.0;
  // No ray starts at w < 0.
  vec3 base = IN_TILE(low);
  base.z = forward > 0.0 ? base.z : IN_TILE(high).z;
  vec3 reach_all = max(abs(low), abs(high));
  vec3 reach = IN_TILE(reach_all);

  float su[kRays], sv[kRays], u0[kRays], v0[kRays], t[kRays];
  uint found[kRays];
  Bounds bounds_in[kParts];
  bool sound = gl_SubgroupSize == kLanes && gl_NumSubgroups == 1u;
  bool any_ray = false;
  [[unroll]] for (uint part = 0u; part < kParts; ++part) {
    Bounds bounds = Bounds(vec4(kFar), vec4(-kFar));
    [[unroll]] for (uint i = 0u; i < kPartRays; ++i) {
      uint r = part * kPartRays + i;
      vec3 d = IN_TILE(directions[r].xyz);
      vec3 o = IN_TILE(starts[r]) - base;
      d.z *= forward;
      o.z *= forward;
      bool goes_on = directions[r].w >= 0.0;
      any_ray = any_ray || goes_on;
      sound = sound && (!goes_on || d.z > kForward);
      float scale = 1.0 / (goes_on ? d.z : 1.0);
      su[r] = d.x * scale;
      sv[r] = d.y * scale;
      u0[r] = o.x - su[r] * o.z;
      v0[r] = o.y - sv[r] * o.z;
      t[r] = goes_on ? kFar : -kFar;
      found[r] = kNoTriangle;
      vec4 form = vec4(su[r], sv[r], u0[r], v0[r]);
      bounds = joined(bounds, Bounds(goes_on ? form : vec4(kFar), goes_on ? form : vec4(-kFar)));
    }
    bounds_in[part] = Bounds(vec4(smallest(bounds.low.xyz), smallest(bounds.low.w)),
                             vec4(largest(bounds.high.xyz), largest(bounds.high.w)));
  }
  uint flags = all_bits((sound ? 0u : 1u) | (any_ray ? 2u : 0u));
  sound = (flags & 1u) == 0u;
  Bounds all = joined(bounds_in[0], bounds_in[kLastPart]);
  vec4 slack = kSlack * vec4(1.0 + most(abs(all.low.x), abs(all.high.x)), 1.0 + most(abs(all.low.y), abs(all.high.y)),
                             reach.x + reach.z + 1e-3, reach.y + reach.z + 1e-3);
  all = Bounds(all.low - slack, all.high + slack);
  [[unroll]] for (uint part = 0u; part < kParts; ++part) {
    bounds_in[part] = Bounds(bounds_in[part].low - slack, bounds_in[part].high + slack);
  }

  float farthest = kFar;  // of the hits that the tile has; kFar while a ray has none
  uint current = 0u;
  farthest = flags == 2u ? farthest : -1.0;
  Stack stack;
  [[unroll]] for (uint i = 0u; i < kStackSlots; ++i) {
    stack.slot[i] = kDone;
  }
  stack.size = 1u;
  stack.top = kDone;
  // Loops rather than branches: a software device takes both sides of a branch, and leaves a loop. It looks whether to
  // go on at the loop's end only: one that asks at its start costs a turn for nothing.
  do {
    do {
      int texel = int(current * kBvhWideNodeTexels + (lane & 7u));
      uvec4 low_q = texelFetch(wide_nodes, texel);
      uvec4 high_q = texelFetch(wide_nodes, texel + int(kBvhWide));
      vec3 box_low = uintBitsToFloat(low_q.xyz);
      vec3 box_high = uintBitsToFloat(high_q.xyz);
      // Fetches stay out of IN_TILE, which would repeat them.
      box_low = IN_TILE(box_low) - base;
      box_high = IN_TILE(box_high) - base;
      float near = forward > 0.0 ? box_low.z : -box_high.z;
      float far = forward > 0.0 ? box_high.z : -box_low.z;
      float margin = kSlack * (reach.z + most(abs(near), abs(far)));
      near = most(near - margin, 0.0);
      far += margin;
      bool hit = lane < kBvhWide && far >= near && near < farthest &&
                 box_high.x - least(all.low.x * near, all.low.x * far) >= all.low.z &&
                 box_low.x - most(all.high.x * near, all.high.x * far) <= all.high.z &&
                 box_high.y - least(all.low.y * near, all.low.y * far) >= all.low.w &&
                 box_low.y - most(all.high.y * near, all.high.y * far) <= all.high.w;
      // Distances order as their bits do; the last three name the lane and make each unlike the others. What comes
      // next does not wait for the stack to be put in order.
      uint key = (floatBitsToUint(near) & ~7u) | lane;
      uint nearest = smallest(hit ? key : kNoKey);
      current = nearest != kNoKey ? OF_LANE(low_q.w, nearest & 7u) : stack.top;
      uint count = total(hit ? 1u : 0u);
      bool fits = stack.size + count <= kStackSlots * kLanes;
      sound = sound && fits;
      farthest = fits ? farthest : -1.0;
      // The farthest lies deepest, the nearest is already taken off.
      key = OF_LANE(sorted(hit ? key | kHitBit : 0u), (lane - stack.size) % kLanes);
      uint reference = OF_LANE(low_q.w, key & 7u);
      [[unroll]] for (uint i = 0u; i < kStackSlots; ++i) {
        stack.slot[i] = kLanes * i + lane - stack.size < count ? reference : stack.slot[i];
      }
      stack.size = max(stack.size + count, 2u) - 1u;
      read_top(stack);
    } while (current < kBvhLeafBit);
    do {
      uint first = 0u;
      uint survivors = 0u;
      vec3 a = vec3(0.0);
      vec3 e1 = vec3(0.0);
      vec3 e2 = vec3(0.0);
      vec3 n = vec3(0.0);
      do {
        uint count = current == kDone ? 0u : current & kBvhLeafCountMask;
        first = current == kDone ? 0u : (current >> kBvhLeafFirstShift) & kBvhLeafFirstMask;
        int texel = int(kBvhTriangleTexels * (first + (lane < count ? lane : 0u)));
        vec3 first_q = texelFetch(bvh_triangles, texel).xyz;
        vec3 second_q = texelFetch(bvh_triangles, texel + 1).xyz;
        vec4 last = texelFetch(bvh_triangles, texel + 2);
        a = IN_TILE(first_q) - base;
        e1 = IN_TILE(second_q);
        e2 = IN_TILE(last.xyz);
        a.z *= forward;
        e1.z *= forward;
        e2.z *= forward;
        vec3 b = a + e1;
        vec3 c = a + e2;
        float near = least(least(a.z, b.z), c.z);
        float far = most(most(a.z, b.z), c.z);
        float margin = kSlack * (reach.z + most(abs(near), abs(far)));
        near -= margin;
        bool kept = lane < count && near < farthest && far + margin >= 0.0;
        n = cross(e1, e2);
        if (HAS(kFeatureCull)) {
          // Its back to every ray; a mirrored tile turns faces round.
          float turned = (floatBitsToUint(last.w) & kBvhCulled) != 0u ? forward : 0.0;
          vec3 m = n * turned;
          float least_against = least(m.x * all.low.x, m.x * all.high.x) + least(m.y * all.low.y, m.y * all.high.y) + m.z;
          kept = kept && least_against <= 0.0;
        }
        uint bits = 0u;
        [[unroll]] for (uint part = 0u; part < kParts; ++part) {
          vec4 l = bounds_in[part].low;
          vec4 m = bounds_in[part].high;
          bool here = kept && most(most(a.x - l.x * a.z, b.x - l.x * b.z), c.x - l.x * c.z) >= l.z &&
                      least(least(a.x - m.x * a.z, b.x - m.x * b.z), c.x - m.x * c.z) <= m.z &&
                      most(most(a.y - l.y * a.z, b.y - l.y * b.z), c.y - l.y * c.z) >= l.w &&
                      least(least(a.y - m.y * a.z, b.y - m.y * b.z), c.y - m.y * c.z) <= m.w;
          bits |= here ? 1u << (8u * part) : 0u;
        }
        survivors = all_bits(bits << (lane & 7u));
        current = stack.top;
        stack.size = max(stack.size, 2u) - 1u;
        read_top(stack);
      } while (survivors == 0u && current >= kBvhLeafBit && current != kDone);
      // Plane and barycentric weights as linear forms of the position (Woop 2004), each in its own invocation.
      float scale = 1.0 / dot(n, n);
      vec3 p = cross(e2, n) * scale;
      vec3 q = cross(n, e1) * scale;
      float dn = dot(n, a);
      float dp = -dot(p, a);
      float dq = -dot(q, a);
      TEST_PART(0u)
      if (kParts > 1u) {
        TEST_PART(kLastPart)
      }
      float worst = t[0];
      [[unroll]] for (uint r = 1u; r < kRays; ++r) {
        worst = most(worst, t[r]);
      }
      farthest = sound ? largest(worst) : -1.0;
    } while (current >= kBvhLeafBit && current != kDone);
  } while (current != kDone);
  [[unroll]] for (uint r = 0u; r < kRays; ++r) {
    int at = pixel_of(r);
    vec4 direction = directions[r];
    // A triangle found for the tile must hold for the ray itself: it may lie within rounding of an edge, or behind the
    // ray's own start, or show it its back; and only the ray can tell a hole in what is cut out.
    bool met = found[r] != kNoTriangle;
    PlaneHit there = plane_hit(met ? found[r] : 0u, starts[r], direction.xyz);
    bool holds = sound && (!met || (is_hit(there, kFarthest) && (there.flags & kBvhCutOut) == 0u &&
                                    ((there.flags & kBvhCulled) == 0u || there.determinant > 0.0)));
    if (at >= 0 && given.is_drawn) {
      hits[at] = found[r];
    }
    if (at >= 0 && direction.w >= 0.0 && !holds) {
      APPEND(left_out, uint(at))
      keep_ray(at, starts[r], direction);
    }
  }
}
