// Where a ray first passes through a lens surface from its eye side (+z) to its object side.
//
// Plane and sphere in closed form, in a form that holds at curvature 0. Everything else by Newton's method on
// f(t) = o_z + t d_z - sag(o_xy + t d_xy), started on the base sphere (the paper's Newton, section 4.1, with a
// tolerance in place of three steps); where that does not settle on a proper crossing - the rim, grazing rays, a
// start outside the patch - a bracketed search over the part of the ray inside the lens's cylinder decides.
//
// A placed surface is met in the axes of its shape: o and d less decentration, slope and height. That is a linear map
// (a shear), which keeps lines and t, but not the length of d.

const int kNewtonSteps = 12;
const int kBracketSamples = 48;
const int kBisectionSteps = 64;
const real kSteepest = real(-0.33);  // slopes (71 degrees of incidence) above which another crossing may come first

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

// The part of a ray within the lens's cylinder, a hair wider so that the rim itself is inside: t from x to y, x > y if
// there is none.
VG_FUNCTION vec2 within_cylinder(KINDS_PARAM SurfaceData s, vec3 o, vec3 d, real semi_diameter) {
  vec2 from_axis = vec2(o.x, o.y);  // of the lens
  real reach = semi_diameter;
  if (IS_PLACED(s)) {
    from_axis += vec2(s.shift.x, s.shift.y);
    reach += abs(s.shift.x) + abs(s.shift.y);
  }
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
      return vec2(real(1), real(0));
    }
    real root = sqrt(disc);
    t0 = max(t0, (-b - root) / a);
    t1 = min(t1, (-b + root) / a);
  }
  return vec2(t0, t1);
}

// What shape_hit does next with the surface at its present t.
const int kNewton = 0;
const int kBracket = 1;  // look for a change of sign, kBracketSamples steps along the ray
const int kRefine = 2;   // Newton's method kept between two t of different sign
const int kMostEvaluations = kNewtonSteps + kBracketSamples + 1 + kBisectionSteps;

const int kHurriedSteps = 2;

// As shape_hit, for an even spline: so many steps of Newton's method in the cell in which the ray meets the base
// sphere, which is fetched once. The ray is unsettled where they do not suffice or lead out of the cell.
VG_FUNCTION SurfaceHit hurried_hit(TABLE_PARAM SurfaceData s, vec3 o, vec3 d, real dd, real semi_diameter) {
  bool sheet = false;
  real t = sphere_crossing(s.frame.w, vec3(o.x, o.y, o.z - s.frame.z), d, dd, sheet);
  vec2 size = vec2(s.shape.y, s.shape.w);  // of cells, inverse
  vec2 across = vec2(d.x, d.y) * size;
  // As even_bspline_point, to the bit.
  vec2 met = vec2((o.x + t * d.x - s.shape.x) * size.x, (o.y + t * d.y - s.shape.z) * size.y);
  int i = int(clamp(met.x, real(0), real(s.kind.z - 1)));
  int j = int(clamp(met.y, real(0), real(s.kind.w - 1)));
  Cell cell = cell_at(TABLE s.offset.x + 4 * (i * s.kind.w + j));
  CellValue value;
  real slope = real(0);
  real dt = real(0);
  for (int step = 0; step <= kHurriedSteps; ++step) {
    t += dt;
    met = vec2((o.x + t * d.x - s.shape.x) * size.x - real(i), (o.y + t * d.y - s.shape.z) * size.y - real(j));
    value = cell_value(cell, met.x, met.y);
    slope = d.z - dot(value.d, across);
    dt = (value.f - o.z - t * d.z) / slope;
  }
  real scale = abs(o.z) + semi_diameter;
  bool settled = sheet && slope < kSteepest && abs(dt) <= real(2) * kEpsilon * scale;
  SurfaceHit hit;
  hit.point = cell_point(value, size);
  hit.point.inside = met.x >= real(0) && met.x <= real(1) && met.y >= real(0) && met.y <= real(1);
  hit.found = settled && hit.point.inside && t >= real(-4) * kEpsilon * scale;
  hit.ledge = false;
  hit.unsettled = !hit.found;
  hit.steps = kHurriedSteps;
  hit.t = hit.found ? max(t, real(0)) : real(0);
  return hit;
}

// In the axes of the surface's shape. Beside the closed forms, one loop with one evaluation of the surface in it: that
// code is by far the largest here, and compilers copy it to each place that calls it.
VG_FUNCTION SurfaceHit shape_hit(TABLE_PARAM KINDS_PARAM SurfaceData s, vec3 o, vec3 d, real semi_diameter) {
  if (IS_KIND(s, kFacets)) {
    return facets_hit(TABLE s, o, d, semi_diameter);
  }
  if (IS_KIND(s, kBezier)) {
    return bezier_hit(TABLE s, o, d, semi_diameter);
  }
  SurfaceHit hit;
  hit.found = false;
  hit.ledge = false;
  hit.unsettled = false;
  hit.steps = -1;
  hit.t = real(0);
  bool sheet = false;
  real dd = real(1);
  if (IS_PLACED(s)) {
    dd = dot(d, d);
  }
  if (CELL_FIRST && NEWTON_STEPS == 0 && IS_KIND(s, kEvenBspline)) {
    SurfaceHit soon = hurried_hit(TABLE s, o, d, dd, semi_diameter);
    if (HURRIED || soon.found) {
      return soon;
    }
  }
  real scale = abs(o.z) + semi_diameter;
  if (IS_KIND(s, kPlane) || IS_KIND(s, kSphere)) {
    real crossing = sphere_crossing(s.shape.x, o, d, dd, sheet);
    hit.t = abs(crossing) <= real(4) * kEpsilon * scale ? real(0) : crossing;  // a start that touches it is a hit
    hit.point = conic_point(TABLE KINDS(kinds) s, vec2(o.x + hit.t * d.x, o.y + hit.t * d.y));
    hit.found = sheet && hit.t >= real(0) && hit.point.inside;
    return hit;
  }
  real t = sphere_crossing(s.frame.w, vec3(o.x, o.y, o.z - s.frame.z), d, dd, sheet);
  int phase = kNewton;
  int steps = 0;        // of the phase
  real last = scale;    // Newton's last step
  real low = real(0);   // on this side of the surface
  real high = real(0);  // beyond it
  bool above = false;
  bool search = !sheet;
  vec2 range = vec2(real(1), real(0));
  if (!HURRIED && NEWTON_STEPS == 0) {
    range = within_cylinder(KINDS(kinds) s, o, d, semi_diameter);
  }
  for (int i = 0; i < kMostEvaluations; ++i) {
    if (search) {
      if (HURRIED || !(range.y > range.x)) {
        hit.unsettled = HURRIED && NEWTON_STEPS == 0;
        break;
      }
      search = false;
      phase = kBracket;
      steps = 0;
      t = range.x;
      low = t;
    }
    SurfacePoint point = shape_point(TABLE KINDS(kinds) s, vec2(o.x + t * d.x, o.y + t * d.y));
    real f = o.z + t * d.z - point.z;
    real slope = d.z - point.gradient.x * d.x - point.gradient.y * d.y;
    ++steps;
    if (phase == kNewton) {
      real dt = -f / slope;
      real size = abs(dt);
      // Rounding ends the iteration: within tolerance, or no longer shrinking once it is near it.
      bool steep = slope < kSteepest;
      bool settled =
          steep && (size <= real(2) * kEpsilon * scale || (size <= real(64) * kEpsilon * scale && size >= last));
      // So many steps and no more: what the ray has come to counts where it runs down through the surface.
      bool spent = NEWTON_STEPS > 0 && steps > NEWTON_STEPS;
      settled = NEWTON_STEPS > 0 ? spent && slope < real(0) : settled;
      if (settled && point.inside && t >= real(-4) * kEpsilon * scale) {
        hit.t = max(t, real(0));
        hit.point = point;
        hit.found = true;
        hit.steps = steps - 1;
        break;
      }
      search = NEWTON_STEPS > 0 ? spent : settled || !steep || steps == kNewtonSteps;
      t += dt;
      last = size;
    } else if (phase == kBracket) {
      if (point.inside && above && f <= real(0)) {
        high = t;
        phase = kRefine;
        steps = 0;
        t = real(0.5) * (low + high);
      } else {
        low = point.inside ? t : low;
        above = point.inside && f > real(0);
        if (steps > kBracketSamples) {
          break;
        }
        t = range.x + (range.y - range.x) * real(steps) / real(kBracketSamples);
      }
    } else {
      low = f > real(0) ? t : low;
      high = f > real(0) ? high : t;
      real next = t - f / slope;
      if (!(next > low && next < high)) {
        next = real(0.5) * (low + high);
      }
      bool done = abs(next - t) <= real(2) * kEpsilon * (abs(t) + abs(o.z));
      t = done ? t : next;
      if (done || steps == kBisectionSteps) {
        hit.t = t;
        hit.point = point;
        hit.found = point.inside;
        break;
      }
    }
  }
  return hit;
}

VG_FUNCTION SurfaceHit placed_hit(TABLE_PARAM KINDS_PARAM SurfaceData s, vec3 o, vec3 d, real semi_diameter) {
  vec3 shape_o = o;
  vec3 shape_d = d;
  if (IS_PLACED(s)) {
    shape_o = vec3(o.x - s.shift.x, o.y - s.shift.y, o.z - s.slope.x * o.x - s.slope.y * o.y - s.shift.z);
    shape_d = vec3(d.x, d.y, d.z - s.slope.x * d.x - s.slope.y * d.y);
  }
  SurfaceHit hit = shape_hit(TABLE KINDS(kinds) s, shape_o, shape_d, semi_diameter);
  if (IS_PLACED(s)) {
    hit.point = placed(s, hit.point, vec2(o.x + hit.t * d.x, o.y + hit.t * d.y));
  }
  return hit;
}

// Base and segment count each on its own side of the boundary; the nearer of what counts is hit. A ray that meets both,
// each on the other's side, has passed the boundary below one of them: it has ended in the ledge's wall. Where the two
// surfaces meet, rounding alone does that, and the base stands for both. Walls that a ray goes through on its way to or
// from a surface that it rightly meets are not seen.
VG_FUNCTION SurfaceHit intersect_surface(TABLE_PARAM KINDS_PARAM SurfaceData s, vec3 o, vec3 d, real semi_diameter) {
  SurfaceHit hit;
  SurfaceHit inner;
  inner.found = false;
  inner.unsettled = false;
  // The segment first, so that what stays is the base's.
  for (int part = IS_SEGMENTED(s) ? 1 : 0; part >= 0; --part) {
    SurfaceData one = s;
    if (IS_SEGMENTED(s) && part == 1) {
      one = segment_surface(TABLE s);
    }
    hit = placed_hit(TABLE KINDS(kinds) one, o, d, semi_diameter);
    if (part == 1) {
      inner = hit;
    }
  }
  if (IS_SEGMENTED(s)) {
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
