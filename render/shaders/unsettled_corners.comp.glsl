#version 460
#extension GL_GOOGLE_include_directive : require
// The listed corners' rays, without hurry.
#include "render/shaders/scene_bindings.glsl"
#include "render/shaders/shading.glsl"
#include "render/shaders/pixel.glsl"
#include "render/shaders/corner_out.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 11) readonly buffer Unsettled { uint unsettled[]; };  // this view's alone

void main() {
  ViewData view = view_data(frame.view.x);
  int across = int(frame.corners.z);
  uint count = unsettled[kListCountAt];
  for (uint i = gl_GlobalInvocationID.x; i < count; i += kListGroup * gl_NumWorkGroups.x) {
    int corner = int(unsettled[kListFirstAt + i]);
    leave_corner(view, ivec2(corner % across, corner / across));
  }
}
