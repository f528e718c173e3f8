#version 460
#extension GL_GOOGLE_include_directive : require
// The ray of every pixel's centre beyond the lens, interpolated between the corners' rays (corners). Where the corners
// around are not all of one kind, a rim or a segment's edge is near: those pixels are listed.
#include "render/shaders/scene_bindings.glsl"
#include "render/shaders/shading.glsl"
#include "render/shaders/pixel.glsl"
#include "render/shaders/ray_out.glsl"
#include "render/shaders/list.glsl"
#define SHOWN_TILES_AT 15
#include "render/shaders/group.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(std430, binding = 12) buffer Mixed { uint mixed_pixels[]; };
layout(binding = 13) uniform samplerBuffer corners;

int corner_at(ivec2 corner) {
  ivec2 count = ivec2(frame.corners.zw);
  corner = clamp(corner, ivec2(0), count - 1);
  return kCornerTexels * ((frame.view.x * count.y + corner.y) * count.x + corner.x);
}

int corner_code(ivec2 corner) { return int(texelFetch(corners, corner_at(corner)).w); }

// Whether the corners of a square and of those around it are alike: an edge may bulge into a square between its corners.
bool alike(ivec2 cell, int code) {
  bool same = true;
  for (int j = -1; j <= 2; ++j) {
    for (int i = -1; i <= 2; ++i) {
      same = same && corner_code(cell + ivec2(i, j)) == code;
    }
  }
  return same;
}

vec4 between(ivec2 cell, vec2 at, int part) {
  vec4 a = texelFetch(corners, corner_at(cell) + part);
  vec4 b = texelFetch(corners, corner_at(cell + ivec2(1, 0)) + part);
  vec4 c = texelFetch(corners, corner_at(cell + ivec2(0, 1)) + part);
  vec4 d = texelFetch(corners, corner_at(cell + ivec2(1, 1)) + part);
  return mix(mix(a, b, at.x), mix(c, d, at.x), at.y);
}

mat2 matrix_between(ivec2 cell, vec2 at, int part) {
  vec4 m = between(cell, at, part);
  return mat2(m.xy, m.zw);
}

void main() {
  ivec2 p = pixel_in_order();
  int eye = frame.view.x;
  if (p.x >= frame.size.x || p.y >= frame.size.y) {
    return;
  }
  ViewData view = view_data(eye);
  int at = (eye * frame.size.y + p.y) * frame.size.x + p.x;
  vec3 direction = pixel_direction(view, vec2(p) + 0.5);
  mat3 turn = eye_turn(int(view.gaze.w), view.gaze.xyz, direction);
  PixelRay ray = unseen_ray(bare_sight_line(view.eye, turn, direction, vec2(0.0), vec2(0.0)));
  if (LENS_USED && view.lens.glass.w != 0.0) {
    vec2 place = (vec2(p) + 0.5) / frame.corners.xy;
    ivec2 cell = min(ivec2(place), ivec2(frame.corners.zw) - 2);
    vec2 within = place - vec2(cell);
    int code = corner_code(cell);
    ray.status = code % kCornerStatusBits;
    if (!alike(cell, code) || ray.status == kStatusUnsettled) {
      APPEND(mixed_pixels, uint(at))
    }
    if (ray.status == kStatusOk) {
      ray.line.start = between(cell, within, 0).xyz;
      ray.line.direction_object = normalize(between(cell, within, 1).xyz);
      ray.line.path.t_back = 0.0;
      ray.line.path.t_front = 1.0;  // any length but 0: it passes
      leave_transfer(RayTransfer(matrix_between(cell, within, 2), matrix_between(cell, within, 3),
                                 matrix_between(cell, within, 4), matrix_between(cell, within, 5)),
                     at);
    }
  }
  leave_ray(view, ray, at);
}
