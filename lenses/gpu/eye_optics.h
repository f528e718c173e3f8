// The eye: thin lens at the entrance pupil, retina one axial length behind it (paper, section 5.4). Powers are carried
// as the excess E - I/l, so that a residual is a difference of small numbers.

struct EyeResponse {
  real accommodation;  // D
  vec3 residual;       // R = V + E - I/l: hh, hv, vv (D)
  vec2 blur;           // semi-axes of the blur ellipse, major first (rad)
  real blur_axis;      // meridian of the major axis, counter-clockwise as the wearer sees it (rad)
};

// The accommodation that best focuses V before it is limited (D).
VG_FUNCTION real accommodation_demand(vec3 v, EyeData eye) {
  return real(-0.5) * (v.x + v.z + eye.excess.x + eye.excess.z);
}

// Principal values of a symmetric matrix (hh, hv, vv): larger, smaller, and the meridian of the larger.
VG_FUNCTION vec3 principal(vec3 s) {
  real mean = real(0.5) * (s.x + s.z);
  real half_difference = real(0.5) * (s.x - s.z);
  real radius = sqrt(half_difference * half_difference + s.y * s.y);
  real axis = radius > real(0) ? real(0.5) * atan(s.y, half_difference) : real(0);
  return vec3(mean + radius, mean - radius, axis);
}

VG_FUNCTION EyeResponse eye_response(vec3 v, EyeData eye, real accommodation) {
  EyeResponse r;
  r.accommodation = accommodation;
  r.residual = v + vec3(eye.excess.x + accommodation, eye.excess.y, eye.excess.z + accommodation);
  vec3 k = principal(r.residual);
  real half_pupil = real(0.5) * eye.pupil.x;
  real first = half_pupil * abs(k.x);
  real second = half_pupil * abs(k.y);
  bool major_is_first = first >= second;
  r.blur = major_is_first ? vec2(first, second) : vec2(second, first);
  r.blur_axis = major_is_first ? k.z : k.z + real(1.5707963267948966);
  return r;
}

VG_FUNCTION real clamped_accommodation(vec3 v, EyeData eye) {
  return clamp(accommodation_demand(v, eye), real(0), eye.excess.w);
}
