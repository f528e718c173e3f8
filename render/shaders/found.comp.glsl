#version 460
#extension GL_GOOGLE_include_directive : require
// One chief ray a pixel, where other kernels have aimed it (rays) and, unless kFindHits says otherwise, found what it
// meets (tile).
#extension GL_KHR_shader_subgroup_shuffle : require
layout(constant_id = 12) const uint kCubicRays = 0u;  // 1: rays are cubics between corners, in smooth tiles alone
#define TRANSFER_IS_KEPT (kKeepTransfer != 0u || kCubicRays != 0u)
#include "render/shaders/scene_bindings.glsl"
#include "render/shaders/shading.glsl"
#include "render/shaders/pixel.glsl"
#define SHOWN_TILES_AT 19
#include "render/shaders/group.glsl"
#include "render/shaders/columns.glsl"
#include "render/shaders/chief_out.glsl"

layout(binding = 13) uniform usamplerBuffer found_hits;
layout(binding = 14) uniform samplerBuffer ray_origins;  // as ray_out.glsl leaves them
layout(binding = 15) uniform samplerBuffer ray_directions;
layout(binding = 16) uniform samplerBuffer kept;
layout(binding = 17) uniform samplerBuffer corners;
layout(binding = 18) uniform usamplerBuffer is_smooth;
layout(constant_id = 7) const uint kFindHits = 0u;  // 1: what a ray meets is found here

#include "render/shaders/tile_cubics.glsl"

struct CubicTransfer {
  ColumnCubic a, b, c, d;
};

ColumnCubic cubic_part(TileCorners tile, int part) {
  return column_cubic(tile.weights, texelFetch(corners, tile.upper + part), texelFetch(corners, tile.lower + part));
}

RayTransfer transfer_of(vec4 a, vec4 b, vec4 c, vec4 d) {
  return RayTransfer(mat2(a.xy, a.zw), mat2(b.xy, b.zw), mat2(c.xy, c.zw), mat2(d.xy, d.zw));
}

RayTransfer kept_transfer(int at) {
  vec4 a = texelFetch(kept, kTransferTexels * at);
  vec4 b = texelFetch(kept, kTransferTexels * at + 1);
  vec4 c = texelFetch(kept, kTransferTexels * at + 2);
  vec4 d = texelFetch(kept, kTransferTexels * at + 3);
  return transfer_of(a, b, c, d);
}

SightLine found_line(ViewData view, mat3 turn, vec3 direction, vec4 origin, vec4 towards) {
  if (!TRANSFER_IS_KEPT) {
    return follow_sight_line(view.lens, view.eye, turn, direction, vec2(origin.w, towards.w));
  }
  SightLine line = bare_sight_line(view.eye, turn, direction, vec2(0.0), vec2(0.0));
  line.direction_object = transpose(mat3(view.world_x.xyz, view.world_y.xyz, view.world_z.xyz)) * towards.xyz;
  return line;
}

// What other kernels know of a pixel's ray.
struct KnownRay {
  vec4 origin;
  vec4 towards;
  bool met;
  Hit hit;
};

// The ray as ray_out.glsl leaves it.
KnownRay known_ray(vec4 origin, vec4 towards, int at) {
  KnownRay known;
  known.origin = origin;
  known.towards = towards;
  uint named = kFindHits == 0u ? texelFetch(found_hits, at).x : kNoTriangle;
  known.met = named != kNoTriangle;
  known.hit = plane_hit(known.met ? named : 0u, known.origin.xyz, known.towards.xyz).hit;
  return known;
}

PixelRay found_ray(ViewData view, vec3 direction, KnownRay known, RayTransfer transfer) {
  vec4 towards = known.towards;
  mat3 turn = eye_turn(int(view.gaze.w), view.gaze.xyz, direction);
  PixelRay ray = unseen_ray(found_line(view, turn, direction, known.origin, towards));
  int beside = LENS_USED && view.lens.glass.w != 0.0 ? kStatusMissBack : kStatusOk;
  ray.status = towards.w > 0.0 ? kStatusOk : towards.w < 0.0 ? int(-towards.w) : beside;
  if (ray.status != kStatusOk) {
    ray.line.direction_object = ray.line.direction;  // there was no lens to follow
  }
  if (TRANSFER_IS_KEPT && towards.w > 0.0) {
    ray.transfer = transfer;
    ray.across = upright_axis(ray.line.e_h, ray.line.direction_object);
  }
  if (!shows_rim(ray.status)) {
    see(view, ray, SceneRay(known.origin.xyz, towards.xyz), kFindHits == 0u, known.met, known.hit);
  }
  return ray;
}

void main() {
  int eye = frame.view.x;
  ViewData view = view_data(eye);
  ivec2 tile = ivec2(group_in_picture());
  bool is_cubic = true;
  ColumnRays rays;
  CubicTransfer cubic;
  if (kCubicRays != 0u) {
    TileCorners at = tile_corners(tile);
    is_cubic = tile_is_smooth(is_smooth, tile);
    rays = column_rays(at, view.world_x, view.world_y, view.world_z);
    cubic = CubicTransfer(cubic_part(at, 2), cubic_part(at, 3), cubic_part(at, 4), cubic_part(at, 5));
  }
  for (int row = 0; row < kColumn; ++row) {
    ivec2 p = pixel_of_column(uvec2(tile), row);
    if (p.x < frame.size.x && p.y < frame.size.y && is_cubic) {
      int at = (eye * frame.size.y + p.y) * frame.size.x + p.x;
      vec4 origin;
      vec4 towards;
      RayTransfer transfer;
      if (kCubicRays != 0u) {
        float t = row_place(row);
        origin = vec4(cubic_origin(rays, row), 0.0);
        towards = vec4(cubic_direction(rays, row), 1.0);
        transfer = transfer_of(at_place(cubic.a, t), at_place(cubic.b, t), at_place(cubic.c, t), at_place(cubic.d, t));
      } else {
        origin = texelFetch(ray_origins, at);
        towards = texelFetch(ray_directions, at);
        transfer = kept_transfer(at);
      }
      KnownRay known = known_ray(origin, towards, at);  // first, so that memory answers while the lens is looked through
      vec3 direction = pixel_direction(view, vec2(p) + 0.5);
      leave_pixel(view, found_ray(view, direction, known, transfer), at);
    }
  }
}
