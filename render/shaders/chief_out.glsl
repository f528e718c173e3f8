// What a pixel's chief ray leaves: radiance, depth, blur ellipse, edge key, and on demand the wavefront itself.

layout(constant_id = 2) const uint kWavefront = 1u;      // 0: pinhole, no wavefront is traced
layout(constant_id = 3) const uint kKeepWavefront = 0u;  // 1: write the wavefront buffer

layout(std430, binding = 10) writeonly buffer Pixels { uvec4 pixels[]; };
layout(std430, binding = 11) writeonly buffer Keys { uvec2 keys[]; };
layout(std430, binding = 12) writeonly buffer Wavefronts { vec4 wavefronts[]; };

void leave_pixel(ViewData view, PixelRay ray, int at) {
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
