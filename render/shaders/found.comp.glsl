#version 460
#extension GL_GOOGLE_include_directive : require
// One chief ray a pixel, where other kernels have aimed it (rays) and found what it meets (tile).
#include "render/shaders/scene_bindings.glsl"
#include "render/shaders/shading.glsl"
#include "render/shaders/pixel.glsl"
#include "render/shaders/group.glsl"
#include "render/shaders/chief_out.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 13) uniform usamplerBuffer found_hits;
layout(binding = 14) uniform samplerBuffer ray_origins;  // as ray_out.glsl leaves them
layout(binding = 15) uniform samplerBuffer ray_directions;

PixelRay found_ray(ViewData view, vec3 direction, int at) {
  vec4 origin = texelFetch(ray_origins, at);
  vec4 towards = texelFetch(ray_directions, at);
  mat3 turn = eye_turn(int(view.gaze.w), view.gaze.xyz, direction);
  PixelRay ray = unseen_ray(follow_sight_line(view.lens, view.eye, turn, direction, vec2(origin.w, towards.w)));
  int beside = LENS_USED && view.lens.glass.w != 0.0 ? kStatusMissBack : kStatusOk;
  ray.status = towards.w > 0.0 ? kStatusOk : towards.w < 0.0 ? int(-towards.w) : beside;
  if (!shows_rim(ray.status)) {
    uint named = texelFetch(found_hits, at).x;
    bool met = named != kNoTriangle;
    Hit hit = plane_hit(met ? named : 0u, origin.xyz, towards.xyz).hit;
    see(view, ray, SceneRay(origin.xyz, towards.xyz), true, met, hit);
  }
  return ray;
}

void main() {
  ivec2 p = pixel_in_picture();
  int eye = frame.view.x;
  if (p.x >= frame.size.x || p.y >= frame.size.y) {
    return;
  }
  ViewData view = views[eye];
  int at = (eye * frame.size.y + p.y) * frame.size.x + p.x;
  vec3 direction = pixel_direction(view, vec2(p) + 0.5);
  leave_pixel(view, found_ray(view, direction, at), at);
}
