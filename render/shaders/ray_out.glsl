// Where the rays kernels leave a pixel's ray beyond the lens, for a traversal that looks at many at once.

// m, world; w: the length in air before the lens.
layout(std430, binding = 10) writeonly buffer Origins { vec4 origins[]; };
// Unit; w: the length in glass, 0 for a ray that meets no lens, minus the status where a rim ends the ray.
layout(std430, binding = 11) writeonly buffer Directions { vec4 directions[]; };
layout(std430, binding = 14) writeonly buffer Kept { vec4 kept[]; };  // kTransferTexels a pixel

void leave_ray(ViewData view, PixelRay ray, int at) {
  SceneRay beyond = scene_ray(view, ray);
  bool through = LENS_USED && view.lens.glass.w != 0.0 && ray.status == kStatusOk;
  vec2 lengths = through ? vec2(ray.line.path.t_back, ray.line.path.t_front) : vec2(0.0);
  if (shows_rim(ray.status)) {
    lengths.y = -float(ray.status);
  } else if (!is_sound(beyond.origin, beyond.direction)) {
    lengths.y = -float(kStatusSingular);
  }
  origins[at] = vec4(beyond.origin, lengths.x);
  directions[at] = vec4(beyond.direction, lengths.y);
}

// After take_transfer.
RayTransfer upright_transfer(PixelRay ray) {
  vec3 upright = upright_axis(ray.line.e_h, ray.line.direction_object);
  return turned_transfer(ray.transfer, ray.across, upright, ray.line.direction_object);
}

void leave_transfer(RayTransfer m, int at) {
  kept[kTransferTexels * at] = vec4(m.a[0], m.a[1]);
  kept[kTransferTexels * at + 1] = vec4(m.b[0], m.b[1]);
  kept[kTransferTexels * at + 2] = vec4(m.c[0], m.c[1]);
  kept[kTransferTexels * at + 3] = vec4(m.d[0], m.d[1]);
}

// All that the frame's later kernels need.
void leave(ViewData view, PixelRay ray, int at) {
  leave_ray(view, ray, at);
  if (kKeepTransfer != 0u) {
    take_transfer(view, ray);
    leave_transfer(upright_transfer(ray), at);
  }
}
