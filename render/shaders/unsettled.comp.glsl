#version 460
#extension GL_GOOGLE_include_directive : require
// The listed rays beyond the lens, without hurry.
#include "render/shaders/scene_bindings.glsl"
#include "render/shaders/shading.glsl"
#include "render/shaders/pixel.glsl"
#include "render/shaders/aim.glsl"
#include "render/shaders/ray_out.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 12) readonly buffer Unsettled { uint unsettled[]; };  // this view's alone

void main() {
  ViewData view = view_data(frame.view.x);
  uint count = unsettled[kListCountAt];
  for (uint i = gl_GlobalInvocationID.x; i < count; i += kListGroup * gl_NumWorkGroups.x) {
    int at = int(unsettled[kListFirstAt + i]);
    int in_view = at - frame.view.x * frame.size.x * frame.size.y;
    leave(view, aim_pixel(view, ivec2(in_view % frame.size.x, in_view / frame.size.x), at), at);
  }
}
