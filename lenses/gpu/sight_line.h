// One line of sight of one eye, with or without a lens: from a direction in head axes to the ray that goes on into the
// scene and, for a distance met there, to the wavefront at the pupil.
//
// The eye sits in primary-gaze axes (origin: entrance pupil in primary gaze). `turn` is the eye's rotation about its
// centre of rotation; matrices and bases are those of the turned eye.

struct SightLine {
  int status;
  mat3 turn;
  vec3 pupil;  // centre of the entrance pupil, primary axes
  vec3 e_h;    // basis of the pupil plane, primary axes
  vec3 e_v;
  vec3 start;  // where the ray leaves for the scene: front hit, or the pupil without a lens
  vec3 back_hit;
  vec3 direction;         // unit, before the lens
  vec3 direction_object;  // unit, beyond it
  LensPath path;
};

// The pupil's place after the eye has turned about a point `depth` behind it.
VG_FUNCTION vec3 turned_pupil(mat3 turn, real depth) {
  vec3 centre = vec3(real(0), real(0), depth);
  return centre - turn * centre;
}

// The line up to the lens, as if there were none. direction: unit, primary axes.
VG_FUNCTION SightLine bare_sight_line(EyeData eye, mat3 turn, vec3 direction, vec2 pupil_offset, vec2 momentum) {
  SightLine line;
  line.status = kStatusOk;
  line.turn = turn;
  line.pupil = turned_pupil(turn, eye.pupil.y);
  vec3 local = transpose(turn) * direction;  // in the turned eye's axes
  vec3 local_h = pupil_basis_h(local);
  vec3 local_v = cross(local_h, local);
  line.e_h = turn * local_h;
  line.e_v = turn * local_v;
  // A ray through another point of the pupil than its centre, for distributed rays (paper, section 6.2).
  line.direction = direction;
  if (momentum.x != real(0) || momentum.y != real(0)) {
    line.direction = normalize(direction + momentum.x * line.e_h + momentum.y * line.e_v);
  }
  line.start = line.pupil + pupil_offset.x * line.e_h + pupil_offset.y * line.e_v;
  line.back_hit = line.start;
  line.direction_object = line.direction;
  return line;
}

#define IS_ON_EYE(lens) (MAY_SIT_ON_EYE && (lens).mount.x == 1)

// What stands in for the eye's axes in front of the lens: a lens attached to the eye is traced in the turned eye's
// frame.
VG_FUNCTION mat3 lens_frame(LensData lens, SightLine line) {
  return IS_ON_EYE(lens) ? line.turn : mat3(real(1));
}
VG_FUNCTION vec3 lens_shift(LensData lens, SightLine line) {
  return IS_ON_EYE(lens) ? line.pupil : vec3(real(0), real(0), real(0));
}

VG_FUNCTION SightLine beyond_lens(LensData lens, SightLine line, LensPath path) {
  line.path = path;
  line.status = path.status;
  if (path.status == kStatusOk) {
    mat3 frame = lens_frame(lens, line);
    vec3 shift = lens_shift(lens, line);
    line.back_hit = frame * from_lens_point(lens, path.back_hit) + shift;
    line.start = frame * from_lens_point(lens, path.front_hit) + shift;
    line.direction_object = frame * from_lens_direction(lens, path.direction_object);
  }
  return line;
}

VG_FUNCTION SightLine trace_sight_line(TABLE_PARAM LensData lens, EyeData eye, mat3 turn, vec3 direction,
                                       vec2 pupil_offset, vec2 momentum) {
  SightLine line = bare_sight_line(eye, turn, direction, pupil_offset, momentum);
  if (!LENS_USED || lens.glass.w == real(0)) {
    return line;
  }
  mat3 to_frame = transpose(lens_frame(lens, line));
  vec3 start = to_lens_point(lens, to_frame * (line.start - lens_shift(lens, line)));
  LensPath path = trace_lens(TABLE lens, start, to_lens_direction(lens, to_frame * line.direction));
  return beyond_lens(lens, line, path);
}

// The chief ray's line again where it is known to pass the lens with these lengths (follow_lens).
VG_FUNCTION SightLine follow_sight_line(TABLE_PARAM LensData lens, EyeData eye, mat3 turn, vec3 direction,
                                        vec2 lengths) {
  SightLine line = bare_sight_line(eye, turn, direction, vec2(real(0), real(0)), vec2(real(0), real(0)));
  if (!LENS_USED || lens.glass.w == real(0)) {
    return line;
  }
  mat3 to_frame = transpose(lens_frame(lens, line));
  vec3 start = to_lens_point(lens, to_frame * (line.start - lens_shift(lens, line)));
  LensPath path = follow_lens(TABLE lens, start, to_lens_direction(lens, to_frame * line.direction), lengths);
  return beyond_lens(lens, line, path);
}

// The ray-transfer matrix from the pupil plane to where the line starts into the scene.
VG_FUNCTION RayTransfer sight_line_transfer(LensData lens, SightLine line) {
  if (!LENS_USED || lens.glass.w == real(0)) {
    return free_flight(real(0));
  }
  mat3 frame = IS_ON_EYE(lens) ? transpose(line.turn) : mat3(real(1));
  return lens_transfer(lens, line.path, to_lens_direction(lens, frame * line.e_h),
                       to_lens_direction(lens, frame * line.e_v));
}

// The first axis of the basis beyond the lens that the transfer is written in: primary axes, unit. The second is its
// cross product with the ray's direction there.
VG_FUNCTION vec3 transfer_axis(LensData lens, SightLine line) {
  if (!LENS_USED || lens.glass.w == real(0)) {
    return line.e_h;
  }
  mat3 frame = lens_frame(lens, line);
  vec3 e = to_lens_direction(lens, transpose(frame) * line.e_h);
  e = normalize(e - dot(e, line.path.direction_glass) * line.path.direction_glass);
  e = normalize(e - dot(e, line.path.direction_object) * line.path.direction_object);
  return frame * from_lens_direction(lens, e);
}

// An axis in its place that needs no more than the ray: what of e_h stands across it.
VG_FUNCTION vec3 upright_axis(vec3 e_h, vec3 direction) {
  return normalize(e_h - dot(e_h, direction) * direction);
}

// The transfer with its outgoing basis turned from one such axis to another.
VG_FUNCTION RayTransfer turned_transfer(RayTransfer m, vec3 from, vec3 to, vec3 direction) {
  real c = dot(from, to);
  real s = dot(cross(from, direction), to);
  mat2 turn = mat2(c, -s, s, c);
  m.a = turn * m.a;
  m.b = turn * m.b;
  m.c = turn * m.c;
  m.d = turn * m.d;
  return m;
}

// V of a point at distance 1/q along the object ray: hh, hv, vv (D). `status` becomes singular where there is none.
VG_FUNCTION vec3 sight_line_vergence(RayTransfer transfer, real q, VG_INOUT(int) status) {
  bool regular = true;
  mat2 v = vergence_matrix(transfer, q, regular);
  if (!regular) {
    status = kStatusSingular;
  }
  return vec3(v[0][0], real(0.5) * (v[0][1] + v[1][0]), v[1][1]);
}
