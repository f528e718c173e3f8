#version 460
#extension GL_GOOGLE_include_directive : require
// The pixels whose neighbours, or whose block, have other faces: what part of the square each face has. Where all of it
// is the middle ray's, nothing is left to do. Else the other faces get a ray each, or, where faces do not tell, the
// pixel as many as a pixel in doubt.
#include "render/shaders/scene_bindings.glsl"
#include "render/shaders/shading.glsl"
#include "render/shaders/pixel.glsl"
#include "render/shaders/beam.glsl"
#include "render/shaders/faces.glsl"
#include "render/shaders/list.glsl"
#include "render/shaders/edge_items.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 10) readonly buffer Doubtful { uint doubtful[]; };  // this view's alone
layout(std430, binding = 11) buffer Edges { uint edges[]; };
layout(std430, binding = 12) buffer Keys { uvec2 keys[]; };  // read for the last time; shares take their place
layout(binding = 13) uniform usamplerBuffer pixels;

const float kLeastLikeness = -1.5;

// How well a face fits what the middle ray met: its slope, less its error in depth; far less than the least that will
// do if it cannot be that face.
float likeness(SquareFace face, uvec2 key, float depth) {
  vec3 normal = vec3((uvec3(key.x) >> uvec3(16u, 21u, 26u)) & 31u) * (2.0 / 31.0) - 1.0;
  bool may_be = has_points(face.points) && (face.material & 0xfffu) == (key.x & 0xfffu);
  return may_be ? dot(normal, face.normal) - 10.0 * abs(face.nearness.x * depth - 1.0) : -1e9;
}

int points_in(uvec4 points) {
  ivec4 bits = bitCount(points);
  return bits.x + bits.y + bits.z + bits.w;
}

// A ray more, through one of these points, that counts for so many; none for none.
void add_share(inout uvec2 shares, inout int rays, uvec4 points, int part) {
  if (part > 0) {
    uint share = uint(part) | (uint(point_among(points)) << kSharePartBits);
    shares.x |= rays == 0 ? share : rays == 1 ? share << 16 : 0u;
    shares.y |= rays == 2 ? share : rays == 3 ? share << 16 : 0u;
    ++rays;
  }
}

// A part of the square, where a face has points in it.
uvec4 points_beside(uvec4 points, uvec4 part) { return has_points(points & part) ? points & part : points; }

// How far away a square may show anything, unless it is a gap that none of the rays around have found.
float farthest_around(ivec2 p) {
  float far = 0.0;
  for (int k = 0; k < 9; ++k) {
    ivec2 q = clamp(p + ivec2(k % 3 - 1, k / 3 - 1), ivec2(0), frame.size.xy - 1);
    int at = (frame.view.x * frame.size.y + q.y) * frame.size.x + q.x;
    float depth = uintBitsToFloat(texelFetch(pixels, at).w);
    far = max(far, depth > 0.0 ? 1.05 * depth : kFarthest);
  }
  return far;
}

void main() {
  ViewData view = view_data(frame.view.x);
  uint count = doubtful[kListCountAt];
  for (uint i = gl_GlobalInvocationID.x; i < count; i += kListGroup * gl_NumWorkGroups.x) {
    uint item = doubtful[kListFirstAt + i];
    uint at = item & ~(kListLit | kListThin);
    int in_view = int(at) - frame.view.x * frame.size.x * frame.size.y;
    vec2 p = vec2(float(in_view % frame.size.x), float(in_view / frame.size.x));
    PixelRay ray = aim_pixel(view, pixel_direction(view, p + 0.5), vec2(0.0), vec2(0.0));
    take_transfer(view, ray);
    float far = farthest_around(ivec2(p));
    SquareFaces faces = square_faces(scene_ray(view, ray), pixel_beam(view, ray), far);
    uvec4 sky = ~points_of_all(faces);
    sky = points_in(sky) > 1 ? sky : uvec4(0u);  // rounding may leave a point between two triangles
    bool unknown = faces.unknown || (has_points(sky) && far < kFarthest);
    // The face that the middle ray has met needs no ray of its own.
    uvec2 key = keys[at];
    float depth = uintBitsToFloat(texelFetch(pixels, int(at)).w);
    vec4 like = vec4(likeness(faces.a, key, depth), likeness(faces.b, key, depth), likeness(faces.c, key, depth),
                     likeness(faces.d, key, depth));
    float best = max(max(max(like.x, like.y), max(like.z, like.w)), kLeastLikeness);
    bool is_sky = depth == 0.0;
    uvec4 a = like.x == best ? faces.a.points : uvec4(0u);
    uvec4 b = like.y == best ? faces.b.points : uvec4(0u);
    uvec4 c = like.z == best ? faces.c.points : uvec4(0u);
    uvec4 d = like.w == best ? faces.d.points : uvec4(0u);
    uvec4 seen = is_sky ? sky : a | b | c | d;
    uvec2 shares = uvec2(0u);
    int rays = 0;
    add_share(shares, rays, faces.a.points & ~seen, points_in(faces.a.points & ~seen));
    add_share(shares, rays, faces.b.points & ~seen, points_in(faces.b.points & ~seen));
    add_share(shares, rays, faces.c.points & ~seen, points_in(faces.c.points & ~seen));
    add_share(shares, rays, faces.d.points & ~seen, points_in(faces.d.points & ~seen));
    add_share(shares, rays, sky & ~seen, points_in(sky & ~seen));
    int others = rays;
    if ((item & kListLit) != 0u) {
      int third = points_in(seen) / 3;
      add_share(shares, rays, points_beside(seen, uvec4(0x00ff00ffu, 0x00ff00ffu, 0u, 0u)), third);
      add_share(shares, rays, points_beside(seen, uvec4(0u, 0u, 0xff00ff00u, 0xff00ff00u)), third);
    }
    if (unknown || others > kMostShares) {
      APPEND(edges, at | (item & kListThin))
    } else if (others > 0) {
      keys[at] = shares;
      APPEND(edges, at | kListShared)
    } else if ((item & kListLit) != 0u) {
      APPEND(edges, at)
    }
  }
}
