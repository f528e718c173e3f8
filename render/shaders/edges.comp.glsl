#version 460
#extension GL_GOOGLE_include_directive : require
// The listed pixels get more rays, so that the radiance becomes the mean over the pixel's square, the filter that every
// mode integrates. Where the faces' parts of the square are known, each face that the first ray does not meet gets one.
// Elsewhere there are four, and where these and the first disagree, or a beam knows of more, a second round of four. The
// nine points share no row and no column, so that a level or upright stroke counts by its width.
#define FOOTPRINT_PIXELS footprint_pixels
float footprint_pixels = 1.0;
#include "render/shaders/scene_bindings.glsl"
#include "render/shaders/shading.glsl"
#include "render/shaders/pixel.glsl"
#include "render/shaders/beam.glsl"
#include "render/shaders/faces.glsl"
#include "render/shaders/list.glsl"
#include "render/shaders/edge_items.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 10) buffer Pixels { uvec4 pixels[]; };
layout(std430, binding = 11) readonly buffer Edges { uint edges[]; };  // this view's alone
layout(std430, binding = 12) buffer Uneven { uint uneven[]; };         // made by the first round for the second
layout(binding = 13) uniform usamplerBuffer shares;                    // where the keys were

void main() {
  ViewData view = view_data(frame.view.x);
  bool again = frame.view.y != 0;
  const vec2 offsets[4] =
      vec2[4](vec2(0.375, 0.125), vec2(0.875, 0.375), vec2(0.125, 0.625), vec2(0.625, 0.875));
  const vec2 more_offsets[4] =
      vec2[4](vec2(0.734, 0.031), vec2(0.031, 0.266), vec2(0.969, 0.734), vec2(0.266, 0.969));
  float each = again ? 1.0 / 9.0 : 0.2;
  uint count = edges[kListCountAt];
  for (uint i = gl_GlobalInvocationID.x; i < count; i += kListGroup * gl_NumWorkGroups.x) {
    uint item = edges[kListFirstAt + i];
    int at = int(item & ~(kListThin | kListShared));
    int in_view = at - frame.view.x * frame.size.x * frame.size.y;
    vec2 p = vec2(float(in_view % frame.size.x), float(in_view / frame.size.x));
    bool shared_out = (item & kListShared) != 0u;
    uvec2 faces = texelFetch(shares, at).xy;
    uvec4 share = uvec4(faces.x & 0xffffu, faces.x >> 16, faces.y & 0xffffu, faces.y >> 16);
    int rays = shared_out && share.w == 0u ? (share.y == 0u ? 1 : share.z == 0u ? 2 : 3) : 4;
    footprint_pixels = shared_out ? 1.0 : 0.5;
    uvec4 pixel = pixels[at];
    vec3 mean = vec3(unpackHalf2x16(pixel.x), unpackHalf2x16(pixel.y).x);
    vec3 sum = vec3(0.0);
    float part = 0.0;
    vec3 least = mean;
    vec3 most = mean;
    for (int k = 0; k < rays; ++k) {
      uint own = k == 0 ? share.x : k == 1 ? share.y : k == 2 ? share.z : share.w;
      vec2 point = square_point(int(own >> kSharePartBits));
      vec2 offset = shared_out ? vec2(0.5 + point.x, 0.5 - point.y) : again ? more_offsets[k] : offsets[k];
      float weight = shared_out ? float(own & ((1u << kSharePartBits) - 1u)) / 128.0 : each;
      vec3 radiance = trace_pixel(view, pixel_direction(view, p + offset), vec2(0.0), vec2(0.0)).radiance;
      sum += weight * radiance;
      part += weight;
      least = min(least, radiance);
      most = max(most, radiance);
    }
    mean = sum + (1.0 - part) * mean;
    pixels[at].x = packHalf2x16(mean.rg);
    pixels[at].y = packHalf2x16(vec2(mean.b, unpackHalf2x16(pixel.y).y));
    bool uneven_here = any(greaterThan(most - least, 0.125 * most + 0.002));
    if (!again && !shared_out && (uneven_here || (item & kListThin) != 0u)) {
      APPEND(uneven, uint(at))
    }
  }
}
