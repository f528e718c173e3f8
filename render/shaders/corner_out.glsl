// What a corner's ray leaves (frame.h).
layout(std430, binding = 10) writeonly buffer CornerRays { vec4 corners[]; };

// Which segments the ray has met.
int segments_met(LensData lens, LensPath path) {
  int met = 0;
  if (lens.back.parts.z > 0 && in_segment(lens.back, path.back_hit.xy)) {
    met += 1;
  }
  if (lens.front.parts.z > 0 && in_segment(lens.front, path.front_hit.xy)) {
    met += 2;
  }
  return met;
}

// The ray's status.
int leave_corner(ViewData view, ivec2 corner) {
  PixelRay ray = aim_pixel(view, pixel_direction(view, vec2(corner) * frame.corners.xy), vec2(0.0), vec2(0.0));
  take_transfer(view, ray);
  vec3 upright = upright_axis(ray.line.e_h, ray.line.direction_object);
  RayTransfer m = turned_transfer(ray.transfer, ray.across, upright, ray.line.direction_object);
  int code = ray.status;
  if (ray.status == kStatusOk && LENS_USED && view.lens.glass.w != 0.0) {
    code += kCornerStatusBits * segments_met(view.lens, ray.line.path);
  }
  // Slopes against the picture's axis: those of a bare eye are linear over the picture. A ray so steep that they are of
  // no use stands for no other.
  float ahead = -dot(ray.line.direction_object, view.picture_z.xyz);
  if (ray.status == kStatusOk && ahead < 0.05) {
    code = kStatusUnsettled;
  }
  int at = kCornerTexels * ((frame.view.x * int(frame.corners.w) + corner.y) * int(frame.corners.z) + corner.x);
  corners[at] = vec4(ray.line.start, float(code));
  corners[at + 1] = vec4(ray.line.direction_object / max(ahead, 0.05), float(code));
  corners[at + 2] = vec4(m.a[0], m.a[1]);
  corners[at + 3] = vec4(m.b[0], m.b[1]);
  corners[at + 4] = vec4(m.c[0], m.c[1]);
  corners[at + 5] = vec4(m.d[0], m.d[1]);
  return ray.status;
}
