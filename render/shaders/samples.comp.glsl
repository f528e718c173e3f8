#version 460
#extension GL_GOOGLE_include_directive : require
// Distributed rays (paper, section 6.2): what one more ray of every pixel sees, where other kernels have aimed it through
// the real lens (rays) and, if kHitsKnown, found what it meets. Sums stay in a buffer between samples; their mean is a
// picture after each.
#define FOOTPRINT_PIXELS 0.25  // the samples themselves average over the pixel
#include "render/shaders/scene_bindings.glsl"
#include "render/shaders/shading.glsl"
#include "render/shaders/pixel.glsl"
#define SHOWN_TILES_AT 15
#include "render/shaders/group.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 8) const uint kHitsKnown = 1u;
layout(std430, binding = 10) buffer Sums { vec4 sums[]; };  // r, g, b; w: luminance, of odd samples less
layout(std430, binding = 11) writeonly buffer Blurred { uvec2 blurred[]; };
layout(binding = 12) uniform usamplerBuffer found_hits;
layout(binding = 13) uniform samplerBuffer ray_origins;  // as ray_out.glsl leaves them
layout(binding = 14) uniform samplerBuffer ray_directions;

// Where neighbouring pixels' rays would run but for the lens: near enough to choose a texture's level.
Beam unbent_beam(ViewData view, vec3 direction) {
  vec2 steps = FOOTPRINT_PIXELS * abs(dot(direction, world_direction(view, view.picture_z.xyz))) *
               vec2((view.tangents.x + view.tangents.y) / float(frame.size.x),
                    (view.tangents.z + view.tangents.w) / float(frame.size.y));
  Beam beam;
  beam.start = Footprint(vec3(0.0), vec3(0.0));
  beam.growth = Footprint(steps.x * world_direction(view, view.picture_x.xyz),
                          steps.y * world_direction(view, view.picture_y.xyz));
  return beam;
}

vec3 sample_radiance(ViewData view, int at) {
  vec4 origin = texelFetch(ray_origins, at);
  vec4 towards = texelFetch(ray_directions, at);
  if (towards.w < 0.0) {
    return kRimRadiance;
  }
  uint named = kHitsKnown != 0u ? texelFetch(found_hits, at).x : kNoTriangle;
  bool met = named != kNoTriangle;
  Hit hit = plane_hit(met ? named : 0u, origin.xyz, towards.xyz).hit;
  Sight sight = look_along(SceneRay(origin.xyz, towards.xyz), unbent_beam(view, towards.xyz), kHitsKnown != 0u, met, hit);
  return seen_radiance(view, towards.w > 0.0 ? kStatusOk : kStatusMissBack, sight.radiance);
}

void main() {
  ivec2 p = pixel_in_picture();
  int eye = frame.view.x;
  if (p.x >= frame.size.x || p.y >= frame.size.y) {
    return;
  }
  int at = (eye * frame.size.y + p.y) * frame.size.x + p.x;
  vec3 radiance = sample_radiance(view_data(eye), at);
  float luminance = dot(radiance, vec3(0.2126, 0.7152, 0.0722));
  vec4 sum = vec4(radiance, (frame.sampling.x & 1) == 0 ? luminance : -luminance);
  if (frame.sampling.x > 0) {
    sum += sums[at];
  }
  sums[at] = sum;
  vec3 mean = sum.rgb / float(frame.sampling.x + 1);
  blurred[at] = uvec2(packHalf2x16(mean.rg), packHalf2x16(vec2(mean.b, 1.0)));
}
