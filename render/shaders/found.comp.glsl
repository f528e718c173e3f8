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

// What other kernels know of a pixel's ray.
struct KnownRay {
  vec4 origin;
  vec4 towards;
  bool met;
  Hit hit;
};

KnownRay known_ray(int at) {
  KnownRay known;
  known.origin = texelFetch(ray_origins, at);
  known.towards = texelFetch(ray_directions, at);
  uint named = texelFetch(found_hits, at).x;
  known.met = named != kNoTriangle;
  known.hit = plane_hit(known.met ? named : 0u, known.origin.xyz, known.towards.xyz).hit;
  return known;
}

PixelRay found_ray(ViewData view, vec3 direction, KnownRay known) {
  mat3 turn = eye_turn(int(view.gaze.w), view.gaze.xyz, direction);
  vec2 lengths = vec2(known.origin.w, known.towards.w);
  PixelRay ray = unseen_ray(follow_sight_line(view.lens, view.eye, turn, direction, lengths));
  int beside = LENS_USED && view.lens.glass.w != 0.0 ? kStatusMissBack : kStatusOk;
  ray.status = lengths.y > 0.0 ? kStatusOk : lengths.y < 0.0 ? int(-lengths.y) : beside;
  if (!shows_rim(ray.status)) {
    see(view, ray, SceneRay(known.origin.xyz, known.towards.xyz), true, known.met, known.hit);
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
  KnownRay known = known_ray(at);  // first, so that memory answers while the lens is looked through
  vec3 direction = pixel_direction(view, vec2(p) + 0.5);
  leave_pixel(view, found_ray(view, direction, known), at);
}
