#version 460
#extension GL_GOOGLE_include_directive : require
// The ray of every pixel's centre beyond the lens, for a traversal that looks at many at once.
#include "render/shaders/scene_bindings.glsl"
#include "render/shaders/shading.glsl"
#include "render/shaders/pixel.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
// m, world; w: the length in air before the lens.
layout(std430, binding = 10) writeonly buffer Origins { vec4 origins[]; };
// Unit; w: the length in glass, 0 for a ray that meets no lens, minus the status where a rim ends the ray.
layout(std430, binding = 11) writeonly buffer Directions { vec4 directions[]; };

void main() {
  ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  int eye = frame.view.x;
  if (p.x >= frame.size.x || p.y >= frame.size.y) {
    return;
  }
  ViewData view = views[eye];
  PixelRay ray = aim_pixel(view, pixel_direction(view, vec2(p) + 0.5), vec2(0.0), vec2(0.0));
  SceneRay beyond = scene_ray(view, ray);
  bool through = LENS_USED && view.lens.glass.w != 0.0 && ray.status == kStatusOk;
  vec2 lengths = through ? vec2(ray.line.path.t_back, ray.line.path.t_front) : vec2(0.0);
  if (shows_rim(ray.status)) {
    lengths.y = -float(ray.status);
  } else if (!is_sound(beyond.origin, beyond.direction)) {
    lengths.y = -float(kStatusSingular);
  }
  int at = (eye * frame.size.y + p.y) * frame.size.x + p.x;
  origins[at] = vec4(beyond.origin, lengths.x);
  directions[at] = vec4(beyond.direction, lengths.y);
}
