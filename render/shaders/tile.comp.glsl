#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_shuffle : require
#extension GL_EXT_control_flow_attributes : require
// The closest triangle to each of a tile's 8 x 8 rays, found for the whole tile at once: one subgroup walks the 8-wide
// tree, each invocation testing one child against bounds that hold all rays of the tile, then one triangle of a leaf;
// what survives is tested against every ray. After the frustum traversal of Reshetov, Soupikov and Hurley,
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
layout(binding = 0) uniform samplerBuffer ray_origins;
layout(binding = 1) uniform samplerBuffer ray_directions;
layout(binding = 2) uniform usamplerBuffer wide_nodes;
layout(binding = 3) uniform samplerBuffer bvh_triangles;
layout(std430, binding = 4) writeonly buffer Hits { uint hits[]; };
layout(std430, binding = 5) buffer LeftOut { uint left_out[]; };  // pixels to be traced one by one
layout(push_constant) uniform Frame { FrameData frame; };

#include "render/shaders/triangle_hit.glsl"
#include "render/shaders/features.h"

const uint kTileSide = 8u;
const uint kRays = kTileSide * kTileSide / kLanes;  // of one invocation
const uint kStackSize = 128u;
const uint kDone = 0xFFFFFFFEu;
const float kFar = 1e30;
// The least cosine between a ray and the main axis; slopes stay below 8.
const float kForward = 0.12;
// Relative, some eight units in the last place: covers the subtraction of the tile's origin and the slopes' products.
const float kSlack = 1e-6;

shared uvec2 stack[kStackSize];  // reference, bits of the entry

// One instruction each on a software device, where min() and max() are three.
float least(float a, float b) { return a < b ? a : b; }
float most(float a, float b) { return a > b ? a : b; }

// On a software device a shuffle costs less than a broadcast, and eight of them less than a reduction.
#define OF_LANE(x, j) subgroupShuffle(x, j)

float largest(float x) {
  if (kLanes != 8u) {
    return subgroupMax(x);
  }
  float m = OF_LANE(x, 0u);
  [[unroll]] for (uint j = 1u; j < 8u; ++j) {
    m = most(m, OF_LANE(x, j));
  }
  return m;
}

uint lanes_with(bool b) {
  if (kLanes != 8u) {
    return subgroupBallot(b).x;
  }
  uint bit = b ? 1u << gl_SubgroupInvocationID : 0u;
  uint m = OF_LANE(bit, 0u);
  [[unroll]] for (uint j = 1u; j < 8u; ++j) {
    m |= OF_LANE(bit, j);
  }
  return m;
}

// The nearest entry that still lies in front of `farthest`; kDone if there is none.
uint pop(inout int top, float farthest) {
  subgroupMemoryBarrierShared();
  uint next = kDone;
  while (top > 0 && next == kDone) {
    --top;
    uvec2 entry = stack[top];
    next = uintBitsToFloat(entry.y) < farthest ? entry.x : kDone;
  }
  subgroupMemoryBarrierShared();
  return next;
}

int pixel_of(uint ray) {
  uint k = gl_SubgroupInvocationID + kLanes * ray;
  ivec2 p = ivec2(gl_WorkGroupID.xy * kTileSide + uvec2(k % kTileSide, k / kTileSide));
  bool outside = p.x >= frame.size.x || p.y >= frame.size.y;
  return outside ? -1 : (frame.view.x * frame.size.y + p.y) * frame.size.x + p.x;
}

void main() {
  uint lane = gl_SubgroupInvocationID;
  vec3 ahead = vec3(0.0);
  vec3 low = vec3(kFar);
  vec3 high = vec3(-kFar);
  [[unroll]] for (uint r = 0u; r < kRays; ++r) {
    int at = pixel_of(r);
    vec4 d = texelFetch(ray_directions, max(at, 0));
    if (at >= 0 && d.w >= 0.0) {
      vec3 o = texelFetch(ray_origins, at).xyz;
      ahead += d.xyz;
      low = vec3(least(low.x, o.x), least(low.y, o.y), least(low.z, o.z));
      high = vec3(most(high.x, o.x), most(high.y, o.y), most(high.z, o.z));
    }
  }
  ahead = subgroupAdd(ahead);
  low = subgroupMin(low);
  high = subgroupMax(high);
  vec3 size = abs(ahead);
  bool along_x = size.x >= size.y && size.x >= size.z;
  bool along_y = !along_x && size.y >= size.z;
#define IN_TILE(v) (along_x ? (v).yzx : along_y ? (v).zxy : (v).xyz)
  float forward = (along_x ? ahead.x : along_y ? ahead.y : ahead.z) < 0.0 ? -1.0 : 1.0;
  // No ray starts at w < 0.
  vec3 base = IN_TILE(low);
  base.z = forward > 0.0 ? base.z : IN_TILE(high).z;
  vec3 reach = IN_TILE(max(abs(low), abs(high)));

  float su[kRays], sv[kRays], u0[kRays], v0[kRays], t[kRays];
  float unsure[kRays];  // where the nearest cut-out triangle is met: the ray alone can tell whether it is there
  uint found[kRays];
  vec4 least_of = vec4(kFar);   // s_u, s_v, u0, v0
  vec4 most_of = vec4(-kFar);
  bool sound = gl_SubgroupSize == kLanes && gl_NumSubgroups == 1u;
  bool any_ray = false;
  [[unroll]] for (uint r = 0u; r < kRays; ++r) {
    int at = pixel_of(r);
    vec4 d4 = texelFetch(ray_directions, max(at, 0));
    vec3 d = IN_TILE(d4.xyz);
    vec3 o = IN_TILE(texelFetch(ray_origins, max(at, 0)).xyz) - base;
    d.z *= forward;
    o.z *= forward;
    bool goes_on = at >= 0 && d4.w >= 0.0;
    any_ray = any_ray || goes_on;
    sound = sound && (!goes_on || d.z > kForward);
    float scale = 1.0 / (goes_on ? d.z : 1.0);
    su[r] = d.x * scale;
    sv[r] = d.y * scale;
    u0[r] = o.x - su[r] * o.z;
    v0[r] = o.y - sv[r] * o.z;
    t[r] = goes_on ? kFar : -kFar;
    unsure[r] = kFar;
    found[r] = kNoTriangle;
    least_of.x = goes_on && su[r] < least_of.x ? su[r] : least_of.x;
    least_of.y = goes_on && sv[r] < least_of.y ? sv[r] : least_of.y;
    least_of.z = goes_on && u0[r] < least_of.z ? u0[r] : least_of.z;
    least_of.w = goes_on && v0[r] < least_of.w ? v0[r] : least_of.w;
    most_of.x = goes_on && su[r] > most_of.x ? su[r] : most_of.x;
    most_of.y = goes_on && sv[r] > most_of.y ? sv[r] : most_of.y;
    most_of.z = goes_on && u0[r] > most_of.z ? u0[r] : most_of.z;
    most_of.w = goes_on && v0[r] > most_of.w ? v0[r] : most_of.w;
  }
  uint flags = subgroupOr((sound ? 0u : 1u) | (any_ray ? 2u : 0u));
  sound = (flags & 1u) == 0u;
  least_of = subgroupMin(least_of);
  most_of = subgroupMax(most_of);
  vec4 slack = kSlack * vec4(1.0 + most(abs(least_of.x), abs(most_of.x)), 1.0 + most(abs(least_of.y), abs(most_of.y)),
                             reach.x + reach.z + 1e-3, reach.y + reach.z + 1e-3);
  least_of -= slack;
  most_of += slack;

  float farthest = kFar;  // of the hits that the tile has; kFar while a ray has none
  uint current = flags == 2u ? 0u : kDone;
  int top = 0;
  // Loops rather than branches: a software device takes both sides of a branch, and leaves a loop.
  while (current != kDone) {
    uint first = 0u;
    uint survivors = 0u;
    vec3 a = vec3(0.0);
    vec3 e1 = vec3(0.0);
    vec3 e2 = vec3(0.0);
    uint triangle_flags = 0u;
    do {
      while (current < kBvhLeafBit) {
        int texel = int(current * kBvhWideNodeTexels + (lane & 7u));
        uvec4 low_q = texelFetch(wide_nodes, texel);
        vec3 box_low = IN_TILE(uintBitsToFloat(low_q.xyz)) - base;
        vec3 box_high = IN_TILE(uintBitsToFloat(texelFetch(wide_nodes, texel + int(kBvhWide)).xyz)) - base;
        float near = forward > 0.0 ? box_low.z : -box_high.z;
        float far = forward > 0.0 ? box_high.z : -box_low.z;
        float margin = kSlack * (reach.z + most(abs(near), abs(far)));
        near = most(near - margin, 0.0);
        far += margin;
        bool hit = lane < kBvhWide && far >= near && near < farthest &&
                   box_high.x - least(least_of.x * near, least_of.x * far) >= least_of.z &&
                   box_low.x - most(most_of.x * near, most_of.x * far) <= most_of.z &&
                   box_high.y - least(least_of.y * near, least_of.y * far) >= least_of.w &&
                   box_low.y - most(most_of.y * near, most_of.y * far) <= most_of.w;
        // The farthest lies deepest on the stack.
        float key = hit ? near : -1.0;
        int place = 0;
        int count = 0;
        [[unroll]] for (uint j = 0u; j < kBvhWide; ++j) {
          float other = OF_LANE(key, j);
          place += other > key || (other == key && j < lane) ? 1 : 0;
          count += other >= 0.0 ? 1 : 0;
        }
        bool fits = top + count <= int(kStackSize);
        sound = sound && fits;
        if (hit && fits) {
          stack[top + place] = uvec2(low_q.w, floatBitsToUint(near));
        }
        top = fits ? top + count : 0;
        current = pop(top, farthest);
      }
      uint count = current == kDone ? 0u : current & kBvhLeafCountMask;
      first = current == kDone ? 0u : (current >> kBvhLeafFirstShift) & kBvhLeafFirstMask;
      int texel = int(kBvhTriangleTexels * (first + (lane < count ? lane : 0u)));
      a = IN_TILE(texelFetch(bvh_triangles, texel).xyz) - base;
      e1 = IN_TILE(texelFetch(bvh_triangles, texel + 1).xyz);
      vec4 last = texelFetch(bvh_triangles, texel + 2);
      e2 = IN_TILE(last.xyz);
      triangle_flags = floatBitsToUint(last.w);
      a.z *= forward;
      e1.z *= forward;
      e2.z *= forward;
      vec3 b = a + e1;
      vec3 c = a + e2;
      float near = least(least(a.z, b.z), c.z);
      float far = most(most(a.z, b.z), c.z);
      float margin = kSlack * (reach.z + most(abs(near), abs(far)));
      bool kept = lane < count && near - margin < farthest && far + margin >= 0.0 &&
                  most(most(a.x - least_of.x * a.z, b.x - least_of.x * b.z), c.x - least_of.x * c.z) >= least_of.z &&
                  least(least(a.x - most_of.x * a.z, b.x - most_of.x * b.z), c.x - most_of.x * c.z) <= most_of.z &&
                  most(most(a.y - least_of.y * a.z, b.y - least_of.y * b.z), c.y - least_of.y * c.z) >= least_of.w &&
                  least(least(a.y - most_of.y * a.z, b.y - most_of.y * b.z), c.y - most_of.y * c.z) <= most_of.w;
      survivors = lanes_with(kept);
      current = survivors == 0u ? pop(top, farthest) : current;
    } while (survivors == 0u && current != kDone);
    // Plane and barycentric weights as linear forms of the position (Woop 2004), each in its own invocation.
    vec3 n = cross(e1, e2);
    float scale = 1.0 / dot(n, n);
    vec3 p = cross(e2, n) * scale;
    vec3 q = cross(n, e1) * scale;
    float dn = dot(n, a);
    float dp = -dot(p, a);
    float dq = -dot(q, a);
    // A mirrored tile turns faces round; a triangle that shows both sides has no sign to heed.
    float turned = (triangle_flags & kBvhCulled) != 0u ? forward : 0.0;
    while (survivors != 0u) {
      uint j = uint(findLSB(survivors));
      survivors &= survivors - 1u;
      vec4 plane = vec4(OF_LANE(n.x, j), OF_LANE(n.y, j), OF_LANE(n.z, j), OF_LANE(dn, j));
      vec4 weight_p = vec4(OF_LANE(p.x, j), OF_LANE(p.y, j), OF_LANE(p.z, j), OF_LANE(dp, j));
      vec4 weight_q = vec4(OF_LANE(q.x, j), OF_LANE(q.y, j), OF_LANE(q.z, j), OF_LANE(dq, j));
      float sign_of_back = HAS(kFeatureCull) ? OF_LANE(turned, j) : 0.0;
      bool cut_out = HAS(kFeatureMask) && (OF_LANE(triangle_flags, j) & kBvhCutOut) != 0u;
      [[unroll]] for (uint r = 0u; r < kRays; ++r) {
        float against = plane.x * su[r] + plane.y * sv[r] + plane.z;
        float w = (plane.w - (plane.x * u0[r] + plane.y * v0[r])) / against;
        float x = u0[r] + w * su[r];
        float y = v0[r] + w * sv[r];
        float k = weight_p.x * x + weight_p.y * y + weight_p.z * w + weight_p.w;
        float l = weight_q.x * x + weight_q.y * y + weight_q.z * w + weight_q.w;
        bool hit = k >= 0.0 && l >= 0.0 && k + l <= 1.0 && w > 0.0 && w < t[r];
        if (HAS(kFeatureCull)) {
          hit = hit && sign_of_back * against <= 0.0;
        }
        if (HAS(kFeatureMask)) {
          unsure[r] = hit && cut_out && w < unsure[r] ? w : unsure[r];
          hit = hit && !cut_out;
        }
        t[r] = hit ? w : t[r];
        found[r] = hit ? first + j : found[r];
      }
    }
    float worst = t[0];
    [[unroll]] for (uint r = 1u; r < kRays; ++r) {
      worst = most(worst, t[r]);
    }
    farthest = largest(worst);
    current = current == kDone ? kDone : pop(top, farthest);
  }
  [[unroll]] for (uint r = 0u; r < kRays; ++r) {
    int at = pixel_of(r);
    // A triangle found for the tile must hold for the ray itself: it may lie within rounding of an edge, or behind the
    // ray's own start.
    vec4 direction = texelFetch(ray_directions, max(at, 0));
    vec3 origin = texelFetch(ray_origins, max(at, 0)).xyz;
    bool met = found[r] != kNoTriangle;
    bool holds = sound && (!met || is_hit(plane_hit(met ? found[r] : 0u, origin, direction.xyz), kFarthest));
    if (HAS(kFeatureMask)) {
      holds = holds && unsure[r] >= t[r];
    }
    if (at >= 0) {
      hits[at] = found[r];
    }
    if (at >= 0 && direction.w >= 0.0 && !holds) {
      APPEND(left_out, uint(at))
    }
  }
}
