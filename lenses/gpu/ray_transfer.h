// The first-order neighbourhood of a chief ray as a symplectic matrix [A B; C D] on (x, p): x the transverse offset,
// p = n times the direction offset. Tracing it outward (pupil, back, front) and asking which p a point source asks for
// gives the wavefront at the pupil with no principal axes, no angles and no special case at infinity, at an umbilic
// or for a focus inside the glass. Convention: vergence is positive when converging (paper, section 5, corrected).
//
// At a surface with tangents T1 = (1, 0, z_x), T2 = (0, 1, z_y) and a transverse basis (e1, e2) let Q_ij = T_i . e_j.
// A tangent-plane point X (contravariant) lies at x = Q^T X; the tangential momentum is Q p, and Snell's law changes
// it by Gamma (hessian / w) X with w = |(-z_x, -z_y, 1)| and Gamma = n' cos phi' - n cos phi. This is the matrix
// diag(1, cos phi) form in the plane of incidence, without having to choose that plane.

struct RayTransfer {
  mat2 a;
  mat2 b;
  mat2 c;
  mat2 d;
};

VG_FUNCTION RayTransfer free_flight(real t) {
  RayTransfer m;
  real one = real(1);
  real zero = real(0);
  m.a = mat2(one, zero, zero, one);
  m.b = mat2(t, zero, zero, t);
  m.c = mat2(zero, zero, zero, zero);
  m.d = mat2(one, zero, zero, one);
  return m;
}

VG_FUNCTION mat2 tangent_projection(vec2 g, vec3 e1, vec3 e2) {
  return mat2(e1.x + g.x * e1.z, e1.y + g.y * e1.z, e2.x + g.x * e2.z, e2.y + g.y * e2.z);
}

VG_FUNCTION mat2 inverse2(mat2 m) {
  real det = m[0][0] * m[1][1] - m[1][0] * m[0][1];
  real k = real(1) / det;
  return mat2(m[1][1] * k, -m[0][1] * k, -m[1][0] * k, m[0][0] * k);
}

// Refracts the matrix at a surface point and carries the transverse basis on to the refracted direction.
VG_FUNCTION RayTransfer refract_transfer(RayTransfer m, SurfacePoint s, real gamma, vec3 d_out, VG_INOUT(vec3) e1,
                                         VG_INOUT(vec3) e2) {
  mat2 q_in = tangent_projection(s.gradient, e1, e2);
  vec3 f1 = normalize(e1 - dot(e1, d_out) * d_out);
  vec3 f2 = cross(f1, d_out);
  mat2 q_out = tangent_projection(s.gradient, f1, f2);
  mat2 to_tangent = transpose(inverse2(q_in));  // x -> X
  mat2 to_outgoing = inverse2(q_out);           // tangential momentum -> p
  real w = sqrt(real(1) + dot(s.gradient, s.gradient));
  real k = gamma / w;
  mat2 bend = mat2(k * s.hessian.x, k * s.hessian.y, k * s.hessian.y, k * s.hessian.z);
  mat2 keep = transpose(q_out) * to_tangent;
  mat2 push = to_outgoing * bend * to_tangent;
  mat2 turn = to_outgoing * q_in;
  RayTransfer r;
  r.a = keep * m.a;
  r.b = keep * m.b;
  r.c = turn * m.c + push * m.a;
  r.d = turn * m.d + push * m.b;
  e1 = f1;
  e2 = f2;
  return r;
}

VG_FUNCTION RayTransfer propagate_transfer(RayTransfer m, real reduced_length) {
  m.a += reduced_length * m.c;
  m.b += reduced_length * m.d;
  return m;
}

// Vergence at the pupil of a point source at distance 1/q beyond the last surface (q = 0: infinity), as a full matrix;
// its asymmetry is rounding. `regular` is false where the source is imaged into the pupil (|V| past 1e8 D).
VG_FUNCTION mat2 vergence_matrix(RayTransfer m, real q, VG_INOUT(bool) regular) {
  mat2 n = m.d + q * m.b;
  mat2 k = m.c + q * m.a;
  real det = n[0][0] * n[1][1] - n[1][0] * n[0][1];
  mat2 adjugate = mat2(n[1][1], -n[0][1], -n[1][0], n[0][0]);
  mat2 v = adjugate * k;
  real largest = max(max(abs(v[0][0]), abs(v[0][1])), max(abs(v[1][0]), abs(v[1][1])));
  regular = largest <= real(1e8) * abs(det) && abs(det) > real(0);
  real scale = regular ? real(-1) / det : real(0);
  return mat2(v[0][0] * scale, v[0][1] * scale, v[1][0] * scale, v[1][1] * scale);
}
