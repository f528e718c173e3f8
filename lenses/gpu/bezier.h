// A spline surface as Bezier patches behind a bounding volume hierarchy (kBezier), the paper's way (section 4.1): a box
// holds a patch's control points and so the patch; a ray is the intersection of two planes with normals N1 and N2, and
// the patch's (u, v) on it solves N1 . (S(u, v) - o) = N2 . (S(u, v) - o) = 0, by Newton's method from the patch's
// middle. A patch: 16 texels, its control points with that along v fastest. A node of the tree: the least corner and a
// first index, the greatest corner and a second; both indices are nodes, or the second is negative and the first a
// patch.

const int kBezierSteps = 8;   // of Newton's method, at most
const int kBezierStack = 24;  // the tree is balanced: enough for 2^24 patches

struct BezierHit {
  bool found;
  real t;
  int first;  // texel of the patch
  vec2 uv;
  int steps;
};

// The cubic Bernstein polynomials, with first and second derivatives.
struct Bernstein {
  vec4 value;
  vec4 slope;
  vec4 bend;
};

VG_FUNCTION Bernstein bernstein(real u) {
  real w = real(1) - u;
  Bernstein b;
  b.value = vec4(w * w * w, real(3) * u * w * w, real(3) * u * u * w, u * u * u);
  b.slope = vec4(real(-3) * w * w, real(3) * w * (w - real(2) * u), real(3) * u * (real(2) * w - u), real(3) * u * u);
  b.bend = vec4(real(6) * w, real(6) * (u - real(2) * w), real(6) * (w - real(2) * u), real(6) * u);
  return b;
}

struct BezierRow {
  vec3 value;
  vec3 slope;
  vec3 bend;
};

VG_FUNCTION vec3 control_point(TABLE_PARAM int at) {
  vec4 p = TABLE_AT(at);
  return vec3(p.x, p.y, p.z);
}

// One row of control points along v.
VG_FUNCTION BezierRow bezier_row(TABLE_PARAM int at, Bernstein b) {
  vec3 p0 = control_point(TABLE at);
  vec3 p1 = control_point(TABLE at + 1);
  vec3 p2 = control_point(TABLE at + 2);
  vec3 p3 = control_point(TABLE at + 3);
  BezierRow row;
  row.value = b.value.x * p0 + b.value.y * p1 + b.value.z * p2 + b.value.w * p3;
  row.slope = b.slope.x * p0 + b.slope.y * p1 + b.slope.z * p2 + b.slope.w * p3;
  row.bend = b.bend.x * p0 + b.bend.y * p1 + b.bend.z * p2 + b.bend.w * p3;
  return row;
}

// S and its derivatives.
struct BezierPoint {
  vec3 s;
  vec3 s_u;
  vec3 s_v;
  vec3 s_uu;
  vec3 s_uv;
  vec3 s_vv;
};

VG_FUNCTION BezierPoint bezier_at(TABLE_PARAM int first, vec2 uv) {
  Bernstein a = bernstein(uv.x);
  Bernstein b = bernstein(uv.y);
  BezierRow r0 = bezier_row(TABLE first, b);
  BezierRow r1 = bezier_row(TABLE first + 4, b);
  BezierRow r2 = bezier_row(TABLE first + 8, b);
  BezierRow r3 = bezier_row(TABLE first + 12, b);
  BezierPoint p;
  p.s = a.value.x * r0.value + a.value.y * r1.value + a.value.z * r2.value + a.value.w * r3.value;
  p.s_u = a.slope.x * r0.value + a.slope.y * r1.value + a.slope.z * r2.value + a.slope.w * r3.value;
  p.s_v = a.value.x * r0.slope + a.value.y * r1.slope + a.value.z * r2.slope + a.value.w * r3.slope;
  p.s_uu = a.bend.x * r0.value + a.bend.y * r1.value + a.bend.z * r2.value + a.bend.w * r3.value;
  p.s_uv = a.slope.x * r0.slope + a.slope.y * r1.slope + a.slope.z * r2.slope + a.slope.w * r3.slope;
  p.s_vv = a.value.x * r0.bend + a.value.y * r1.bend + a.value.z * r2.bend + a.value.w * r3.bend;
  return p;
}

// The patch as a height field z(x, y), by the chain rule.
VG_FUNCTION SurfacePoint height_of(BezierPoint p) {
  real det = p.s_u.x * p.s_v.y - p.s_u.y * p.s_v.x;
  real guard = abs(det) > real(0) ? det : real(1);
  vec2 g = vec2(p.s_u.z * p.s_v.y - p.s_v.z * p.s_u.y, p.s_v.z * p.s_u.x - p.s_u.z * p.s_v.x) / guard;
  vec2 ux = vec2(p.s_v.y, -p.s_u.y) / guard;  // u_x, v_x
  vec2 uy = vec2(-p.s_v.x, p.s_u.x) / guard;  // u_y, v_y
  vec3 r = vec3(p.s_uu.z - g.x * p.s_uu.x - g.y * p.s_uu.y, p.s_uv.z - g.x * p.s_uv.x - g.y * p.s_uv.y,
                p.s_vv.z - g.x * p.s_vv.x - g.y * p.s_vv.y);
  SurfacePoint point;
  point.z = p.s.z;
  point.gradient = g;
  point.hessian = vec3(r.x * ux.x * ux.x + real(2) * r.y * ux.x * ux.y + r.z * ux.y * ux.y,
                       r.x * ux.x * uy.x + r.y * (ux.x * uy.y + ux.y * uy.x) + r.z * ux.y * uy.y,
                       r.x * uy.x * uy.x + real(2) * r.y * uy.x * uy.y + r.z * uy.y * uy.y);
  point.inside = abs(det) > real(0);
  return point;
}

// The ray on one patch, nearer than `best`.
VG_FUNCTION BezierHit patch_hit(TABLE_PARAM int first, vec3 o, vec3 d, vec2 range) {
  vec3 n1 = abs(d.x) < abs(d.z) ? normalize(cross(d, vec3(real(1), real(0), real(0))))
                                : normalize(cross(d, vec3(real(0), real(1), real(0))));
  vec3 n2 = cross(d, n1);
  BezierHit hit;
  hit.found = false;
  hit.t = real(0);
  hit.first = first;
  hit.uv = vec2(real(0.5), real(0.5));
  hit.steps = 0;
  bool settled = false;
  int most = NEWTON_STEPS > 0 ? NEWTON_STEPS : kBezierSteps;
  for (int step = 0; step < kBezierSteps; ++step) {
    if (settled || step >= most) {
      break;
    }
    BezierPoint p = bezier_at(TABLE first, hit.uv);
    vec3 from = p.s - o;
    vec2 miss = vec2(dot(n1, from), dot(n2, from));
    vec2 j_u = vec2(dot(n1, p.s_u), dot(n2, p.s_u));
    vec2 j_v = vec2(dot(n1, p.s_v), dot(n2, p.s_v));
    real det = j_u.x * j_v.y - j_u.y * j_v.x;
    real guard = abs(det) > real(0) ? det : real(1);
    vec2 delta = vec2(j_v.x * miss.y - j_v.y * miss.x, j_u.y * miss.x - j_u.x * miss.y) / guard;
    // A step may leave the patch and come back, but not run away from it.
    hit.uv = clamp(hit.uv + delta, vec2(real(-1), real(-1)), vec2(real(2), real(2)));
    hit.steps = step + 1;
    // The next step would be of the order of the square: rounding.
    settled = max(abs(delta.x), abs(delta.y)) <= real(3e-5);
    vec3 normal = cross(p.s_u, p.s_v);
    hit.t = dot(from + delta.x * p.s_u + delta.y * p.s_v, d) / dot(d, d);
    real slack = real(1e-4);  // neighbours overlap by a hair
    hit.found = dot(normal, d) < real(0) && hit.t >= range.x && hit.t <= range.y && hit.uv.x >= -slack &&
                hit.uv.y >= -slack && hit.uv.x <= real(1) + slack && hit.uv.y <= real(1) + slack;
  }
  hit.found = hit.found && (settled || NEWTON_STEPS > 0);
  return hit;
}

VG_FUNCTION bool meets_box(vec3 low, vec3 high, vec3 o, vec3 inverse, vec2 range) {
  vec3 a = (low - o) * inverse;
  vec3 b = (high - o) * inverse;
  real enter = max(max(min(a.x, b.x), min(a.y, b.y)), max(min(a.z, b.z), range.x));
  real leave = min(min(max(a.x, b.x), max(a.y, b.y)), min(max(a.z, b.z), range.y));
  return enter <= leave;
}

// No component is 0 or infinite: 1e-20 is no length that a lens has.
VG_FUNCTION real box_inverse(real d) { return real(1) / (abs(d) > real(1e-20) ? d : real(1e-20)); }

// The first patch along the ray with t in the range.
VG_FUNCTION BezierHit first_patch(TABLE_PARAM SurfaceData s, vec3 o, vec3 d, vec2 range) {
  BezierHit best;
  best.found = false;
  best.t = range.y;
  best.first = 0;
  best.uv = vec2(real(0), real(0));
  best.steps = 0;
  vec3 inverse = vec3(box_inverse(d.x), box_inverse(d.y), box_inverse(d.z));
  int stack[kBezierStack];
  int top = 1;
  stack[0] = 0;
  for (int visited = 0; visited < 2 * s.kind.z && top > 0; ++visited) {
    int node = stack[--top];
    vec4 low = TABLE_AT(s.offset.y + 2 * node);
    vec4 high = TABLE_AT(s.offset.y + 2 * node + 1);
    if (!meets_box(vec3(low.x, low.y, low.z), vec3(high.x, high.y, high.z), o, inverse, vec2(range.x, best.t))) {
      continue;
    }
    if (high.w < real(0)) {
      BezierHit one = patch_hit(TABLE s.offset.x + 16 * int(low.w), o, d, vec2(range.x, best.t));
      if (one.found) {
        best = one;
      }
    } else {
      stack[top] = int(low.w);
      stack[top + 1] = int(high.w);
      top += 2;
    }
  }
  return best;
}

VG_FUNCTION SurfaceHit bezier_hit(TABLE_PARAM SurfaceData s, vec3 o, vec3 d, real semi_diameter) {
  SurfaceHit hit;
  hit.found = false;
  hit.ledge = false;
  hit.unsettled = false;
  hit.steps = -1;
  hit.t = real(0);
  hit.point.inside = false;
  real scale = abs(o.z) + semi_diameter;
  BezierHit found = first_patch(TABLE s, o, d, vec2(real(-4) * kEpsilon * scale, real(16) * scale));
  if (found.found) {
    BezierPoint p = bezier_at(TABLE found.first, found.uv);
    hit.t = max(dot(p.s - o, d) / dot(d, d), real(0));
    hit.point = height_of(p);
    hit.found = hit.point.inside;
    hit.steps = found.steps;
  }
  return hit;
}

// The patches at a point of the lens's plane: what a ray straight through it meets.
VG_FUNCTION SurfacePoint bezier_point(TABLE_PARAM SurfaceData s, vec2 p) {
  SurfacePoint point;
  point.z = real(0);
  point.gradient = vec2(real(0), real(0));
  point.hessian = vec3(real(0), real(0), real(0));
  point.inside = false;
  vec3 o = vec3(p.x, p.y, real(0));
  BezierHit found = first_patch(TABLE s, o, vec3(real(0), real(0), real(-1)), vec2(real(-1), real(1)));
  if (found.found) {
    point = height_of(bezier_at(TABLE found.first, found.uv));
  }
  return point;
}
