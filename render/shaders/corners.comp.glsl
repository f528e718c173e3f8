#version 460
#extension GL_GOOGLE_include_directive : require
// The lens's rays at the corners of squares of the picture, for pixels that are interpolated between them; those whose
// path does not settle at once are listed.
#define HURRIED true
#include "render/shaders/scene_bindings.glsl"
#include "render/shaders/shading.glsl"
#include "render/shaders/pixel.glsl"
#include "render/shaders/corner_out.glsl"
#include "render/shaders/list.glsl"
#include "render/shaders/columns.glsl"

layout(std430, binding = 11) buffer Unsettled { uint unsettled[]; };

void main() {
  ViewData view = view_data(frame.view.x);
  ivec2 count = ivec2(frame.corners.zw);
  for (int row = 0; row < kColumn; ++row) {
    ivec2 corner = pixel_of_column(gl_WorkGroupID.xy, row);
    if (corner.x < count.x && corner.y < count.y) {
      if (leave_corner(view, corner) == kStatusUnsettled) {
        APPEND(unsettled, uint(corner.y * count.x + corner.x))
      }
    }
  }
}
