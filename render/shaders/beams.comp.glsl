#version 460
#extension GL_GOOGLE_include_directive : require
// The doubtful pixels, each with its own beam: those that meet more than their ray shows are edges too.
#include "render/shaders/scene_bindings.glsl"
#include "render/shaders/shading.glsl"
#include "render/shaders/pixel.glsl"
#include "render/shaders/beam.glsl"
#include "render/shaders/list.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 10) readonly buffer Doubtful { uint doubtful[]; };  // this view's alone
layout(std430, binding = 11) buffer Edges { uint edges[]; };

void main() {
  ViewData view = view_data(frame.view.x);
  uint count = doubtful[kListCountAt];
  for (uint i = gl_GlobalInvocationID.x; i < count; i += kListGroup * gl_NumWorkGroups.x) {
    uint at = doubtful[kListFirstAt + i];
    int in_view = int(at) - frame.view.x * frame.size.x * frame.size.y;
    vec2 p = vec2(float(in_view % frame.size.x), float(in_view / frame.size.x));
    if (square_shows_more(view, p + 0.5, kShowsAnything)) {
      APPEND(edges, at | kListThin)
    }
  }
}
