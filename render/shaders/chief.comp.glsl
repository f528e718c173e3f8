#version 460
#extension GL_GOOGLE_include_directive : require
// One chief ray a pixel, through the pixel's centre: radiance, depth, blur ellipse, edge key, and on demand the
// wavefront itself.
#include "render/shaders/scene_bindings.glsl"
#include "render/shaders/shading.glsl"
#include "render/shaders/pixel.glsl"

layout(constant_id = 2) const uint kWavefront = 1u;       // 0: pinhole, no wavefront is traced
layout(constant_id = 3) const uint kKeepWavefront = 0u;   // 1: write the wavefront buffer
layout(constant_id = 5) const uint kFound = 0u;           // 1: other kernels have found what every ray meets

layout(local_size_x = 8, local_size_y = 8) in;
layout(std430, binding = 10) writeonly buffer Pixels { uvec4 pixels[]; };
layout(std430, binding = 11) writeonly buffer Keys { uvec2 keys[]; };
layout(std430, binding = 12) writeonly buffer Wavefronts { vec4 wavefronts[]; };
layout(binding = 13) uniform usamplerBuffer found_hits;
layout(binding = 14) uniform samplerBuffer ray_origins;  // as rays.comp.glsl leaves them
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
    see(view, ray, SceneRay(origin.xyz, towards.xyz), met, hit);
  }
  return ray;
}

void main() {
  ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  int eye = frame.view.x;
  if (p.x >= frame.size.x || p.y >= frame.size.y) {
    return;
  }
  ViewData view = views[eye];
  int at = (eye * frame.size.y + p.y) * frame.size.x + p.x;
  vec3 direction = pixel_direction(view, vec2(p) + 0.5);
  PixelRay ray;
  if (kFound != 0u) {
    ray = found_ray(view, direction, at);
  } else {
    ray = trace_pixel(view, direction, vec2(0.0), vec2(0.0));
  }
  vec3 ellipse = vec3(0.0);
  if (kWavefront != 0u) {
    PixelWavefront w = pixel_wavefront(view, ray);
    if (!shows_rim(ray.status)) {
      ellipse = blur_in_pixels(view, ray, w.response.residual);
    }
    if (kKeepWavefront != 0u) {
      wavefronts[kWavefrontTexels * at] = vec4(w.vergence, w.response.accommodation);
      wavefronts[kWavefrontTexels * at + 1] = vec4(w.response.blur.x, ray.depth, float(ray.status), 0.0);
    }
  }
  pixels[at] = pack_pixel(ray.radiance, ellipse, ray.depth);
  if (kBare == 0u) {  // a bare picture has no edge rays
    keys[at] = pack_key(ray);
  }
}
