#version 460
#extension GL_GOOGLE_include_directive : require
// One chief ray a pixel, through the pixel's centre: radiance, depth, blur ellipse, edge key, and on demand the
// wavefront itself.
#include "render/shaders/scene_bindings.glsl"
#include "render/shaders/shading.glsl"
#include "render/shaders/pixel.glsl"

layout(constant_id = 2) const uint kWavefront = 1u;       // 0: pinhole, no wavefront is traced
layout(constant_id = 3) const uint kKeepWavefront = 0u;   // 1: write the wavefront buffer
layout(constant_id = 4) const uint kTile = 0u;            // 1: tile_hits holds what every ray meets

layout(local_size_x = 8, local_size_y = 8) in;
layout(std430, binding = 10) writeonly buffer Pixels { uvec4 pixels[]; };
layout(std430, binding = 11) writeonly buffer Keys { uint keys[]; };
layout(std430, binding = 12) writeonly buffer Wavefronts { vec4 wavefronts[]; };
layout(binding = 13) uniform usamplerBuffer tile_hits;

// What the pixel's ray meets.
bool meets(SceneRay ray, int at, out Hit hit) {
  if (kTile == 0u) {
    return trace_closest(ray.origin, ray.direction, kFarthest, hit);
  }
  uint named = texelFetch(tile_hits, at).x;
  hit = plane_hit(named == kTileMiss ? 0u : named, ray.origin, ray.direction);
  return named != kTileMiss;
}

void main() {
  ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  int eye = frame.view.x;
  if (p.x >= frame.size.x || p.y >= frame.size.y) {
    return;
  }
  ViewData view = views[eye];
  int at = (eye * frame.size.y + p.y) * frame.size.x + p.x;
  PixelRay ray = aim_pixel(view, pixel_direction(view, vec2(p) + 0.5), vec2(0.0), vec2(0.0));
  if (!shows_rim(ray.status)) {
    SceneRay beyond = scene_ray(view, ray);
    Hit hit;
    bool found = meets(beyond, at, hit);
    see(view, ray, beyond, found, hit);
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
  keys[at] = pack_key(ray);
}
