// The eye as it turns: its numbers, its axes, the basis of its pupil plane.

const int kViewingFixed = 0;
const int kViewingScanning = 1;
const int kViewingGaze = 2;

struct EyeData {
  vec4 excess;  // relaxed E - I/l: hh, hv, vv (D); w: amplitude of accommodation (D)
  vec4 pupil;   // pupil diameter (m), centre of rotation behind the pupil (m), accommodation if fixed (D), -
};

// Listing's law: the smallest rotation from -z to a unit gaze direction. 1 - g_z is taken from the sine where it would
// cancel; straight back it is the half turn about y.
VG_FUNCTION mat3 listing_rotation(vec3 g) {
  real s2 = g.x * g.x + g.y * g.y;
  real k = g.z <= real(0) ? real(1) / (real(1) - g.z) : (s2 > real(0) ? (real(1) + g.z) / s2 : real(0));
  real xx = g.z > real(0) && !(s2 > real(0)) ? real(2) : k * g.x * g.x;
  return mat3(real(1) - xx, -k * g.x * g.y, g.x, -k * g.x * g.y, real(1) - k * g.y * g.y, g.y, -g.x, -g.y, -g.z);
}

// The pupil plane's basis for a ray of direction d (unit): e_h = normalize(d x y), e_v = e_h x d. A ray straight up or
// down takes the direction's own limit from ahead.
VG_FUNCTION vec3 pupil_basis_h(vec3 d) {
  real flat2 = d.x * d.x + d.z * d.z;
  return flat2 > kEpsilon * kEpsilon ? vec3(-d.z, real(0), d.x) / sqrt(flat2) : vec3(real(1), real(0), real(0));
}

#define IS_VIEWING(viewing, k) ((VIEWINGS & (1u << uint(k))) != 0u && (VIEWINGS == (1u << uint(k)) || (viewing) == (k)))

VG_FUNCTION mat3 eye_turn(int viewing, vec3 gaze, vec3 direction) {
  if (IS_VIEWING(viewing, kViewingFixed)) {
    return mat3(real(1));
  }
  if (IS_VIEWING(viewing, kViewingScanning)) {
    return listing_rotation(direction);
  }
  return listing_rotation(gaze);
}
