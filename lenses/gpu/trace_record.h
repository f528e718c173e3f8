// One ray in, one wavefront out: the record of the `trace` command, the same in every engine.

struct TraceInput {
  vec4 direction;  // from the pupil outward, primary axes, unit; w: 1/distance from the front surface, 0 at infinity
  vec4 gaze;       // primary axes, unit
  ivec4 which;     // lens, eye, viewing, -
};

struct TraceOutput {
  ivec4 status;
  vec4 vergence;   // hh, hv, vv; w: accommodation
  vec4 residual;   // hh, hv, vv; w: blur axis
  vec4 blur;       // major, minor; asymmetry of V before it was symmetrised, -
  vec4 back_hit;   // primary axes
  vec4 front_hit;
  vec4 object_direction;
};

VG_FUNCTION TraceOutput trace_record(TABLE_PARAM LensData lens, EyeData eye, TraceInput ray) {
  vec3 direction = vec3(ray.direction.x, ray.direction.y, ray.direction.z);
  mat3 turn = eye_turn(ray.which.z, vec3(ray.gaze.x, ray.gaze.y, ray.gaze.z), direction);
  vec2 centre = vec2(real(0), real(0));
  SightLine line = trace_sight_line(TABLE lens, eye, turn, direction, centre, centre);
  vec4 nothing = vec4(real(0), real(0), real(0), real(0));
  TraceOutput result;
  result.status = ivec4(line.status, 0, 0, 0);
  result.vergence = nothing;
  result.residual = nothing;
  result.blur = nothing;
  result.back_hit = vec4(line.back_hit, real(0));
  result.front_hit = vec4(line.start, real(0));
  result.object_direction = vec4(line.direction_object, real(0));
  if (line.status != kStatusOk) {
    return result;
  }
  RayTransfer transfer = sight_line_transfer(lens, line);
  bool regular = true;
  mat2 v = vergence_matrix(transfer, ray.direction.w, regular);
  if (!regular) {
    result.status.x = kStatusSingular;
    return result;
  }
  vec3 vergence = vec3(v[0][0], real(0.5) * (v[0][1] + v[1][0]), v[1][1]);
  real accommodation = clamped_accommodation(vergence, eye);
  EyeResponse response = eye_response(vergence, eye, accommodation);
  result.vergence = vec4(vergence, accommodation);
  result.residual = vec4(response.residual, response.blur_axis);
  result.blur = vec4(response.blur, v[0][1] - v[1][0], real(0));
  return result;
}
