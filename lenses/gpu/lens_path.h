// One ray through one lens: pupil -> back -> front. Positions and directions in the lens frame (origin: back vertex).

const int kStatusOk = 0;
const int kStatusMissBack = 1;
const int kStatusMissFront = 2;
const int kStatusTirFront = 3;
const int kStatusInverted = 4;
const int kStatusSingular = 5;
const int kStatusUnsettled = 6;  // of a HURRIED trace alone

struct LensData {
  vec4 axis_x;  // columns of the rotation eye_from_lens; w: the translation's components
  vec4 axis_y;
  vec4 axis_z;
  vec4 glass;   // index, centre thickness, half diameter, 1 if there is a lens at all
  ivec4 mount;  // x: 1 if attached to the eye, y: 1 if its surfaces may cross
  SurfaceData back;
  SurfaceData front;
};

struct LensPath {
  int status;
  vec3 start;
  vec3 back_hit;
  vec3 front_hit;
  vec3 direction;  // in air, before the lens
  vec3 direction_glass;
  vec3 direction_object;  // in air, beyond the lens
  real t_back;            // pupil to back surface
  real t_front;           // back to front surface
  int steps_back;         // of the searches for the surfaces (SurfaceHit)
  int steps_front;
  real gamma_back;
  real gamma_front;
  SurfacePoint back;
  SurfacePoint front;
};

VG_FUNCTION vec3 to_lens_direction(LensData lens, vec3 d) {
  return vec3(dot(lens.axis_x, vec4(d, real(0))), dot(lens.axis_y, vec4(d, real(0))),
              dot(lens.axis_z, vec4(d, real(0))));
}

VG_FUNCTION vec3 to_lens_point(LensData lens, vec3 p) {
  return to_lens_direction(lens, p - vec3(lens.axis_x.w, lens.axis_y.w, lens.axis_z.w));
}

VG_FUNCTION vec3 from_lens_direction(LensData lens, vec3 d) {
  return vec3(lens.axis_x.x, lens.axis_x.y, lens.axis_x.z) * d.x +
         vec3(lens.axis_y.x, lens.axis_y.y, lens.axis_y.z) * d.y +
         vec3(lens.axis_z.x, lens.axis_z.y, lens.axis_z.z) * d.z;
}

VG_FUNCTION vec3 from_lens_point(LensData lens, vec3 p) {
  return from_lens_direction(lens, p) + vec3(lens.axis_x.w, lens.axis_y.w, lens.axis_z.w);
}

// Of a vector that is of unit length but for rounding.
VG_FUNCTION vec3 renormalized(vec3 d) {
  return d * (real(1.5) - real(0.5) * dot(d, d));
}

// Snell's law for a unit direction at a height field crossed towards -z. Returns n' cos phi' - n cos phi, or 0 with
// `transmitted` false at total internal reflection. The sine comes from the cross product, which keeps its digits
// near normal incidence.
VG_FUNCTION real refract_direction(vec3 d, vec2 gradient, real n_in, real n_out, VG_INOUT(vec3) refracted,
                                   VG_INOUT(bool) transmitted) {
  vec3 normal = vec3(gradient.x, gradient.y, real(-1));  // w times the unit normal
  real ww = real(1) + dot(gradient, gradient);
  vec3 across = cross(d, normal);
  real mu = n_in / n_out;
  real under = ww - mu * mu * dot(across, across);
  transmitted = under > real(0);
  if (!transmitted) {
    return real(0);
  }
  real cos_in = dot(d, normal);
  real cos_out = sqrt(under);
  refracted = renormalized(mu * d + ((cos_out - mu * cos_in) / ww) * normal);
  return (n_out * cos_out - n_in * cos_in) / sqrt(ww);
}

// start and direction in the lens frame; direction of unit length.
VG_FUNCTION LensPath trace_lens(TABLE_PARAM LensData lens, vec3 start, vec3 direction) {
  LensPath path;
  path.status = kStatusMissBack;
  path.start = start;
  path.direction = direction;
  path.direction_object = direction;
  path.front_hit = start;
  path.steps_back = -1;
  path.steps_front = -1;
  real index = lens.glass.x;
  real semi_diameter = lens.glass.z;
  SurfaceHit back = intersect_surface(TABLE KINDS(BACK_KINDS) lens.back, start, direction, semi_diameter);
  vec3 p = start + back.t * direction;
  bool within = p.x * p.x + p.y * p.y <= semi_diameter * semi_diameter;
  if (!back.found || !within) {
    // In the wall of a ledge light is stopped as at the rim; only what passes beside the lens misses the back.
    path.status = back.ledge && within ? kStatusMissFront : kStatusMissBack;
    path.status = back.unsettled ? kStatusUnsettled : path.status;
    return path;
  }
  path.back = back.point;
  path.t_back = back.t;
  path.steps_back = back.steps;
  path.back_hit = p;
  bool transmitted = false;
  path.gamma_back =
      refract_direction(direction, back.point.gradient, real(1), index, path.direction_glass, transmitted);
  if (!transmitted) {
    return path;
  }
  // The front surface is met in its own vertex frame, where the thickness of a thin lens keeps its digits.
  path.status = kStatusInverted;
  vec3 o = vec3(p.x, p.y, back.point.z + lens.glass.y);
  if (MAY_CROSS) {
    SurfacePoint above = surface_point(TABLE KINDS(FRONT_KINDS) lens.front, vec2(p.x, p.y));
    if (above.inside && !(o.z > above.z)) {
      return path;
    }
  }
  SurfaceHit front = intersect_surface(TABLE KINDS(FRONT_KINDS) lens.front, o, path.direction_glass, semi_diameter);
  path.status = front.unsettled ? kStatusUnsettled : kStatusMissFront;
  vec3 exit = o + front.t * path.direction_glass;
  if (!front.found || !(exit.x * exit.x + exit.y * exit.y <= semi_diameter * semi_diameter)) {
    return path;
  }
  path.front = front.point;
  path.t_front = front.t;
  path.steps_front = front.steps;
  path.front_hit = vec3(exit.x, exit.y, exit.z - lens.glass.y);
  path.gamma_front =
      refract_direction(path.direction_glass, front.point.gradient, index, real(1), path.direction_object, transmitted);
  path.status = transmitted ? kStatusOk : kStatusTirFront;
  return path;
}

// e_h, e_v: the basis of the pupil plane, in the lens frame.
VG_FUNCTION RayTransfer lens_transfer(LensData lens, LensPath path, vec3 e_h, vec3 e_v) {
  vec3 e1 = e_h;
  vec3 e2 = e_v;
  RayTransfer m = free_flight(path.t_back);
  m = refract_transfer(m, path.back, path.gamma_back, path.direction_glass, e1, e2);
  m = propagate_transfer(m, path.t_front / lens.glass.x);
  return refract_transfer(m, path.front, path.gamma_front, path.direction_object, e1, e2);
}

// The path of a ray that trace_lens has found to pass, followed again from its lengths in air and in glass (t_back,
// t_front) without searching for the surfaces.
VG_FUNCTION LensPath follow_lens(TABLE_PARAM LensData lens, vec3 start, vec3 direction, vec2 lengths) {
  LensPath path;
  path.status = kStatusOk;
  path.start = start;
  path.direction = direction;
  path.t_back = lengths.x;
  path.t_front = lengths.y;
  path.back_hit = start + lengths.x * direction;
  path.back = surface_point(TABLE KINDS(BACK_KINDS) lens.back, vec2(path.back_hit.x, path.back_hit.y));
  bool transmitted = false;
  path.gamma_back =
      refract_direction(direction, path.back.gradient, real(1), lens.glass.x, path.direction_glass, transmitted);
  vec3 exit = vec3(path.back_hit.x, path.back_hit.y, path.back.z + lens.glass.y) + lengths.y * path.direction_glass;
  path.front = surface_point(TABLE KINDS(FRONT_KINDS) lens.front, vec2(exit.x, exit.y));
  path.front_hit = vec3(exit.x, exit.y, exit.z - lens.glass.y);
  path.gamma_front = refract_direction(path.direction_glass, path.front.gradient, lens.glass.x, real(1),
                                       path.direction_object, transmitted);
  return path;
}
