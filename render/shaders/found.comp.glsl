#version 460
#extension GL_GOOGLE_include_directive : require
// One chief ray a pixel, where other kernels have aimed it (rays) and, unless kFindHits says otherwise, found what it
// meets (tile).
// CUBIC_RAYS: of smooth tiles alone, whose rays are cubics between corners.
#ifdef CUBIC_RAYS
#extension GL_KHR_shader_subgroup_shuffle : require
#define TRANSFER_IS_KEPT true
#define SHOWN_TILES_AT 16
#else
#define TRANSFER_IS_KEPT (kKeepTransfer != 0u)
#define SHOWN_TILES_AT 17
#endif
#include "render/shaders/scene_bindings.glsl"
#include "render/shaders/shading.glsl"
#include "render/shaders/pixel.glsl"
#include "render/shaders/group.glsl"
#include "render/shaders/columns.glsl"
#include "render/shaders/chief_out.glsl"

layout(binding = 13) uniform usamplerBuffer found_hits;
layout(constant_id = 7) const uint kFindHits = 0u;  // 1: what a ray meets is found here

RayTransfer transfer_of(vec4 a, vec4 b, vec4 c, vec4 d) {
  return RayTransfer(mat2(a.xy, a.zw), mat2(b.xy, b.zw), mat2(c.xy, c.zw), mat2(d.xy, d.zw));
}

// As ray_out.glsl leaves a ray.
struct GivenRay {
  vec4 origin;
  vec4 towards;
  RayTransfer transfer;
};

#ifdef CUBIC_RAYS
layout(binding = 14) uniform samplerBuffer corners;
layout(binding = 15) uniform usamplerBuffer is_smooth;
#include "render/shaders/tile_cubics.glsl"

// What an invocation knows of its column.
struct GivenColumn {
  bool is_drawn;
  ColumnRays rays;
  ColumnCubic a, b, c, d;
};

ColumnCubic cubic_part(TileCorners tile, int part) {
  return column_cubic(tile.weights, texelFetch(corners, tile.upper + part), texelFetch(corners, tile.lower + part));
}

GivenColumn given_column(ViewData view, ivec2 tile) {
  TileCorners at = tile_corners(tile);
  return GivenColumn(tile_is_smooth(is_smooth, tile), column_rays(at, view.world_x, view.world_y, view.world_z),
                     cubic_part(at, 2), cubic_part(at, 3), cubic_part(at, 4), cubic_part(at, 5));
}

GivenRay given_ray(GivenColumn column, int row, int at) {
  float t = row_place(row);
  return GivenRay(vec4(cubic_origin(column.rays, row), 0.0), vec4(cubic_direction(column.rays, row), 1.0),
                  transfer_of(at_place(column.a, t), at_place(column.b, t), at_place(column.c, t),
                              at_place(column.d, t)));
}
#else
layout(binding = 14) uniform samplerBuffer ray_origins;
layout(binding = 15) uniform samplerBuffer ray_directions;
layout(binding = 16) uniform samplerBuffer kept;

struct GivenColumn {
  bool is_drawn;
};

GivenColumn given_column(ViewData view, ivec2 tile) { return GivenColumn(true); }

GivenRay given_ray(GivenColumn column, int row, int at) {
  vec4 a = texelFetch(kept, kTransferTexels * at);
  vec4 b = texelFetch(kept, kTransferTexels * at + 1);
  vec4 c = texelFetch(kept, kTransferTexels * at + 2);
  vec4 d = texelFetch(kept, kTransferTexels * at + 3);
  return GivenRay(texelFetch(ray_origins, at), texelFetch(ray_directions, at), transfer_of(a, b, c, d));
}
#endif

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
  GivenRay ray;
  bool met;
  Hit hit;
};

KnownRay known_ray(GivenRay ray, int at) {
  KnownRay known;
  known.ray = ray;
  uint named = kFindHits == 0u ? texelFetch(found_hits, at).x : kNoTriangle;
  known.met = named != kNoTriangle;
  known.hit = plane_hit(known.met ? named : 0u, ray.origin.xyz, ray.towards.xyz).hit;
  return known;
}

PixelRay found_ray(ViewData view, vec3 direction, KnownRay known) {
  vec4 towards = known.ray.towards;
  mat3 turn = eye_turn(int(view.gaze.w), view.gaze.xyz, direction);
  PixelRay ray = unseen_ray(found_line(view, turn, direction, known.ray.origin, towards));
  int beside = LENS_USED && view.lens.glass.w != 0.0 ? kStatusMissBack : kStatusOk;
  ray.status = towards.w > 0.0 ? kStatusOk : towards.w < 0.0 ? int(-towards.w) : beside;
  if (ray.status != kStatusOk) {
    ray.line.direction_object = ray.line.direction;  // there was no lens to follow
  }
  if (TRANSFER_IS_KEPT && towards.w > 0.0) {
    ray.transfer = known.ray.transfer;
    ray.across = upright_axis(ray.line.e_h, ray.line.direction_object);
  }
  if (!shows_rim(ray.status)) {
    see(view, ray, SceneRay(known.ray.origin.xyz, towards.xyz), kFindHits == 0u, known.met, known.hit);
  }
  return ray;
}

void main() {
  int eye = frame.view.x;
  ViewData view = view_data(eye);
  uvec2 tile = group_in_picture();
  GivenColumn column = given_column(view, ivec2(tile));
  for (int row = 0; row < kColumn; ++row) {
    ivec2 p = pixel_of_column(tile, row);
    if (p.x < frame.size.x && p.y < frame.size.y && column.is_drawn) {
      int at = (eye * frame.size.y + p.y) * frame.size.x + p.x;
      // First, so that memory answers while the lens is looked through.
      KnownRay known = known_ray(given_ray(column, row, at), at);
      vec3 direction = pixel_direction(view, vec2(p) + 0.5);
      leave_pixel(view, found_ray(view, direction, known), at);
    }
  }
}
