#version 460
#extension GL_GOOGLE_include_directive : require
// One chief ray a pixel, through the pixel's centre: radiance, depth, blur ellipse, edge key, and on demand the
// wavefront itself.
#include "render/shaders/scene_bindings.glsl"
#include "render/shaders/shading.glsl"
#include "render/shaders/pixel.glsl"

layout(constant_id = 2) const uint kWavefront = 1u;       // 0: pinhole, no wavefront is traced
layout(constant_id = 3) const uint kKeepWavefront = 0u;   // 1: write the wavefront buffer

layout(local_size_x = 8, local_size_y = 8) in;
layout(std430, binding = 10) writeonly buffer Pixels { uvec4 pixels[]; };
layout(std430, binding = 11) writeonly buffer Keys { uvec2 keys[]; };
layout(std430, binding = 12) writeonly buffer Wavefronts { vec4 wavefronts[]; };

void main() {
  ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  int eye = int(gl_GlobalInvocationID.z);
  if (p.x >= frame.size.x || p.y >= frame.size.y) {
    return;
  }
  ViewData view = views[eye];
  PixelRay ray = trace_pixel(view, pixel_direction(view, vec2(p) + 0.5), vec2(0.0), vec2(0.0));
  vec3 ellipse = vec3(0.0);
  int at = (eye * frame.size.y + p.y) * frame.size.x + p.x;
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
