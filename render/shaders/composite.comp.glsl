#version 460
#extension GL_GOOGLE_include_directive : require
// A picture from layers of fewer pixels: one that covers it all, enlarged, and one around the gaze that fades into it.
#include "render/shaders/composite.h"
#include "render/shaders/display.glsl"

const int kMostComposedViews = 4;  // kMostViews

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform usamplerBuffer whole_radiance;
layout(binding = 1) uniform usamplerBuffer fovea_radiance;
layout(std430, binding = 2) writeonly buffer Radiance { uvec2 radiance[]; };
layout(std430, binding = 3) writeonly buffer Display { uint display[]; };
layout(binding = 4) uniform Composite { CompositeData data_of[kMostComposedViews]; };
layout(push_constant) uniform Which { int view; };

vec3 unpacked(uvec2 packed) { return vec3(unpackHalf2x16(packed.x), unpackHalf2x16(packed.y).x); }

uvec2 fetched(bool fovea, ivec2 size, ivec2 p) {
  p = clamp(p, ivec2(0), size - 1);
  int at = (view * size.y + p.y) * size.x + p.x;
  return fovea ? texelFetch(fovea_radiance, at).xy : texelFetch(whole_radiance, at).xy;
}

// Catmull and Rom 1974, of the texels -1, 0, 1, 2.
vec4 spline_weights(float t) {
  return vec4(t * (-0.5 + t * (1.0 - 0.5 * t)), 1.0 + t * t * (-2.5 + 1.5 * t), t * (0.5 + t * (2.0 - 1.5 * t)),
              t * t * (-0.5 + 0.5 * t));
}

// p: a pixel of the layer's extent. Enlarged by a spline in linear light, which goes through the texels and is held
// between the four nearest, so that nothing bright has a dark ring.
vec3 layer_at(bool fovea, ivec2 size, ivec2 extent, ivec2 p) {
  if (size == extent) {
    return unpacked(fetched(fovea, size, p));
  }
  vec2 at = (vec2(p) + 0.5) * vec2(size) / vec2(extent) - 0.5;
  ivec2 corner = ivec2(floor(at));
  vec4 across = spline_weights(at.x - float(corner.x));
  vec4 down = spline_weights(at.y - float(corner.y));
  vec3 sum = vec3(0.0);
  vec3 least = vec3(65504.0);
  vec3 most = vec3(0.0);
  for (int k = 0; k < 16; ++k) {
    ivec2 o = ivec2(k & 3, k >> 2);
    vec3 texel = unpacked(fetched(fovea, size, corner + o - 1));
    sum += across[o.x] * down[o.y] * texel;
    bool nearest = (o.x == 1 || o.x == 2) && (o.y == 1 || o.y == 2);
    least = nearest ? min(least, texel) : least;
    most = nearest ? max(most, texel) : most;
  }
  return clamp(sum, least, most);
}

// 1 where the fovea's layer is shown alone, 0 where the whole's is; and 0 as far from the end of the fovea's layer as a
// blur there would have gathered from beyond it.
float fovea_share(CompositeData data, ivec2 p) {
  if (data.fovea.x == 0) {
    return 0.0;
  }
  ivec2 low = p - data.fovea.zw;
  ivec2 high = data.extent.xy - 1 - low;
  // The picture's own border is no end: the full picture ends there too.
  const int far = 1 << 20;
  low += ivec2(data.fovea.z == 0 ? far : 0, data.fovea.w == 0 ? far : 0);
  ivec2 beyond = data.shown.xy - data.fovea.zw - data.extent.xy;
  high += ivec2(beyond.x == 0 ? far : 0, beyond.y == 0 ? far : 0);
  float inside = float(min(min(low.x, low.y), min(high.x, high.y)));
  if (inside < 0.0) {
    return 0.0;
  }
  float reach = float(data.shown.w);
  float whole_blur = clamp((inside - reach) / max(0.5 * reach, 1.0), 0.0, 1.0);
  vec2 share = (vec2(p) + 0.5) / vec2(data.shown.xy);
  vec2 t = vec2(mix(-data.tangents.x, data.tangents.y, share.x), mix(data.tangents.w, -data.tangents.z, share.y));
  return whole_blur * smoothstep(data.limits.y, data.limits.x, dot(normalize(vec3(t, -1.0)), data.gaze.xyz));
}

void main() {
  ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  CompositeData data = data_of[view];
  if (p.x >= data.shown.x || p.y >= data.shown.y) {
    return;
  }
  float share = fovea_share(data, p);
  vec3 seen = vec3(0.0);
  if (share < 1.0) {
    seen = layer_at(false, data.whole.xy, data.shown.xy, p);
  }
  if (share > 0.0) {
    vec3 sharp = layer_at(true, data.fovea.xy, data.extent.xy, p - data.fovea.zw);
    seen = share < 1.0 ? mix(seen, sharp, share) : sharp;
  }
  uvec2 packed = uvec2(packHalf2x16(seen.rg), packHalf2x16(vec2(seen.b, 1.0)));
  int at = (view * data.shown.y + p.y) * data.shown.x + p.x;
  if (data.shown.z != 0) {
    radiance[at] = packed;
  }
  display[at] = display_bytes(packed, data.gaze.w);
}
