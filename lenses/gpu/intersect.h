// Where a ray first passes through a lens surface from its eye side (+z) to its object side.
//
// Plane and sphere in closed form, in a form that holds at curvature 0. Everything else by Newton's method on
// f(t) = o_z + t d_z - sag(o_xy + t d_xy), started on the base sphere (the paper's Newton, section 4.1, with a
// tolerance in place of three steps); where that does not settle on a proper crossing - the rim, grazing rays, a
// start outside the patch - a bracketed search over the part of the ray inside the lens's cylinder decides.
//
// A placed surface is met in the axes of its shape: o and d less decentration, slope and height. That is a linear map
// (a shear), which keeps lines and t, but not the length of d.

struct SurfaceHit {
  bool found;
  bool ledge;      // not found, as the ray ends in the wall between a segment and its base, before t
  bool unsettled;  // not found, and not searched for any longer (HURRIED)
  real t;
  SurfacePoint point;
};

const int kNewtonSteps = 12;
const int kBracketSamples = 48;
const int kBisectionSteps = 64;

// The crossing of a sphere of curvature c through the origin's vertex, from the eye side outwards:
// c |p|^2 - 2 p_z = 0. Returns a negative t where there is none. `sheet` is set where it lies on the vertex's half.
// dd: |d|^2, given so that for a unit direction it is exactly 1.
VG_FUNCTION real sphere_crossing(real c, vec3 o, vec3 d, real dd, VG_INOUT(bool) sheet) {
  real b = c * dot(o, d) - d.z;
  real k = c * dot(o, o) - real(2) * o.z;
  real disc = b * b - c * dd * k;
  sheet = false;
  if (!(disc >= real(0))) {
    return real(-1);
  }
  real root = sqrt(disc);
  real t = real(-1);
  if (b > real(0)) {
    t = -k / (b + root);
  } else if (c != real(0)) {
    t = (root - b) / (c * dd);
  }
  sheet = real(1) - c * (o.z + t * d.z) > real(0);
  return t;
}

VG_FUNCTION SurfaceHit bracketed_hit(TABLE_PARAM KINDS_PARAM SurfaceData s, vec3 o, vec3 d, real semi_diameter) {
  SurfaceHit hit;
  hit.found = false;
  hit.ledge = false;
  hit.unsettled = false;
  hit.t = real(0);
  vec2 from_axis = vec2(o.x, o.y);  // of the lens
  real reach = semi_diameter;
  if (IS_PLACED(s)) {
    from_axis += vec2(s.shift.x, s.shift.y);
    reach += abs(s.shift.x) + abs(s.shift.y);
  }
  // The part of the ray within the lens's cylinder, a hair wider so that the rim itself is inside.
  real a = d.x * d.x + d.y * d.y;
  real b = from_axis.x * d.x + from_axis.y * d.y;
  real radius = semi_diameter * real(1.0001);
  real c = from_axis.x * from_axis.x + from_axis.y * from_axis.y - radius * radius;
  real t0 = real(0);
  // As far as any sag a lens can have; a ray across the axis ends at the cylinder instead.
  real t1 = (abs(o.z) + real(4) * reach) / max(abs(d.z), kEpsilon);
  if (a > kEpsilon * kEpsilon) {
    real disc = b * b - a * c;
    if (!(disc >= real(0))) {
      return hit;
    }
    real root = sqrt(disc);
    t0 = max(t0, (-b - root) / a);
    t1 = min(t1, (-b + root) / a);
  }
  if (!(t1 > t0)) {
    return hit;
  }
  real low = t0;
  real high = t0;
  bool above = false;
  bool bracketed = false;
  for (int i = 0; i <= kBracketSamples; ++i) {
    real t = t0 + (t1 - t0) * real(i) / real(kBracketSamples);
    vec2 q = vec2(o.x + t * d.x, o.y + t * d.y);
    SurfacePoint point = shape_point(TABLE KINDS(kinds) s, q);
    real f = o.z + t * d.z - point.z;
    if (!point.inside) {
      above = false;
    } else if (above && f <= real(0)) {
      high = t;
      bracketed = true;
      break;
    } else {
      above = f > real(0);
      low = t;
    }
  }
  if (!bracketed) {
    return hit;
  }
  real t = real(0.5) * (low + high);
  for (int i = 0; i < kBisectionSteps; ++i) {
    vec2 q = vec2(o.x + t * d.x, o.y + t * d.y);
    hit.point = shape_point(TABLE KINDS(kinds) s, q);
    real f = o.z + t * d.z - hit.point.z;
    if (f > real(0)) {
      low = t;
    } else {
      high = t;
    }
    real slope = d.z - hit.point.gradient.x * d.x - hit.point.gradient.y * d.y;
    real next = t - f / slope;
    if (!(next > low && next < high)) {
      next = real(0.5) * (low + high);
    }
    if (abs(next - t) <= real(2) * kEpsilon * (abs(t) + abs(o.z))) {
      break;
    }
    t = next;
  }
  hit.t = t;
  hit.found = hit.point.inside;
  return hit;
}

// In the axes of the surface's shape.
VG_FUNCTION SurfaceHit shape_hit(TABLE_PARAM KINDS_PARAM SurfaceData s, vec3 o, vec3 d, real semi_diameter) {
  SurfaceHit hit;
  hit.found = false;
  hit.ledge = false;
  hit.unsettled = false;
  bool sheet = false;
  real dd = real(1);
  if (IS_PLACED(s)) {
    dd = dot(d, d);
  }
  real scale = abs(o.z) + semi_diameter;
  if (IS_KIND(s, kPlane) || IS_KIND(s, kSphere)) {
    real t = sphere_crossing(s.shape.x, o, d, dd, sheet);
    hit.t = abs(t) <= real(4) * kEpsilon * scale ? real(0) : t;  // a start that touches the surface is a hit
    vec2 q = vec2(o.x + hit.t * d.x, o.y + hit.t * d.y);
    hit.point = shape_point(TABLE KINDS(kinds) s, q);
    hit.found = sheet && hit.t >= real(0) && hit.point.inside;
    return hit;
  }
  vec3 from_guess = vec3(o.x, o.y, o.z - s.frame.z);
  real t = sphere_crossing(s.frame.w, from_guess, d, dd, sheet);
  bool settled = false;
  if (sheet) {
    real last = scale;
    for (int i = 0; i < kNewtonSteps; ++i) {
      vec2 q = vec2(o.x + t * d.x, o.y + t * d.y);
      hit.point = shape_point(TABLE KINDS(kinds) s, q);
      real slope = d.z - hit.point.gradient.x * d.x - hit.point.gradient.y * d.y;
      // Below this slope (71 degrees of incidence) another crossing may come first; the search decides.
      if (!(slope < real(-0.33))) {
        break;
      }
      real dt = -(o.z + t * d.z - hit.point.z) / slope;
      real size = abs(dt);
      // Rounding ends the iteration: within tolerance, or no longer shrinking once it is near it.
      if (size <= real(2) * kEpsilon * scale || (size <= real(64) * kEpsilon * scale && size >= last)) {
        settled = true;
        break;
      }
      t += dt;
      last = size;
    }
  }
  if (settled && hit.point.inside && t >= real(-4) * kEpsilon * scale) {
    hit.t = max(t, real(0));
    hit.found = true;
    return hit;
  }
  if (HURRIED) {
    hit.t = real(0);
    hit.unsettled = true;
    return hit;
  }
  return bracketed_hit(TABLE KINDS(kinds) s, o, d, semi_diameter);
}

VG_FUNCTION SurfaceHit placed_hit(TABLE_PARAM KINDS_PARAM SurfaceData s, vec3 o, vec3 d, real semi_diameter) {
  if (IS_PLACED(s)) {
    vec3 shape_o = vec3(o.x - s.shift.x, o.y - s.shift.y, o.z - s.slope.x * o.x - s.slope.y * o.y - s.shift.z);
    vec3 shape_d = vec3(d.x, d.y, d.z - s.slope.x * d.x - s.slope.y * d.y);
    SurfaceHit hit = shape_hit(TABLE KINDS(kinds) s, shape_o, shape_d, semi_diameter);
    hit.point = placed(s, hit.point, vec2(o.x + hit.t * d.x, o.y + hit.t * d.y));
    return hit;
  }
  return shape_hit(TABLE KINDS(kinds) s, o, d, semi_diameter);
}

// Base and segment count each on its own side of the boundary; the nearer of what counts is hit. A ray that meets both,
// each on the other's side, has passed the boundary below one of them: it has ended in the ledge's wall. Where the two
// surfaces meet, rounding alone does that, and the base stands for both. Walls that a ray goes through on its way to or
// from a surface that it rightly meets are not seen.
VG_FUNCTION SurfaceHit intersect_surface(TABLE_PARAM KINDS_PARAM SurfaceData s, vec3 o, vec3 d, real semi_diameter) {
  SurfaceHit hit = placed_hit(TABLE KINDS(kinds) s, o, d, semi_diameter);
  if (IS_SEGMENTED(s)) {
    SurfaceHit inner = placed_hit(TABLE KINDS(kinds) segment_surface(TABLE s), o, d, semi_diameter);
    if (HURRIED && (hit.unsettled || inner.unsettled)) {
      hit.t = real(0);
      hit.found = false;
      hit.unsettled = true;
      return hit;
    }
    bool hit_counts = hit.found && !in_segment(TABLE s, vec2(o.x + hit.t * d.x, o.y + hit.t * d.y));
    bool inner_counts = inner.found && in_segment(TABLE s, vec2(o.x + inner.t * d.x, o.y + inner.t * d.y));
    if (inner_counts && !(hit_counts && hit.t <= inner.t)) {
      return inner;
    }
    if (!hit_counts) {
      bool both = hit.found && inner.found;
      bool meet = both && abs(hit.t - inner.t) <= real(16) * kEpsilon * (abs(o.z) + semi_diameter);
      hit.t = both ? max(hit.t, inner.t) : real(0);
      hit.ledge = both && !meet;
      hit.found = meet;
    }
  }
  return hit;
}
