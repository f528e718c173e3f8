// A surface as a mesh of triangles (kFacets), as others model lenses and the paper (section 4) avoids to: the vertices
// lie on a square grid, two triangles to a square, and carry the surface's height and gradient. Rays meet the flat
// triangles, found from square to square along the ray; the normal there is interpolated between the vertices' ("smooth
// shading"), and curvature is what the vertices' gradients differ by over the triangle. In cells of n a side the hit is
// off by O(1/n^2), the direction of a refracted ray as well, the curvature by O(1/n).

// The plane of heights and gradients over one triangle: a vertex at a corner of the square, what changes along the
// square's sides. A texel of the mesh: z, z_x, z_y, 1 where the surface exists.
struct Facet {
  vec4 corner;
  vec4 along_x;
  vec4 along_y;
  vec2 at;      // of the corner, in sides of the square
  bool sound;   // the surface exists at all three vertices
};

VG_FUNCTION Facet facet_of(TABLE_PARAM SurfaceData s, int i, int j, bool upper) {
  int at = s.offset.x + i * (s.kind.w + 1) + j;
  vec4 low_x = TABLE_AT(upper ? at + 1 : at);  // the ends of the side along x
  vec4 high_x = TABLE_AT(upper ? at + s.kind.w + 2 : at + s.kind.w + 1);
  vec4 other = TABLE_AT(upper ? at + s.kind.w + 1 : at + 1);
  Facet facet;
  facet.corner = upper ? high_x : low_x;
  facet.along_x = high_x - low_x;
  facet.along_y = upper ? high_x - other : other - low_x;
  facet.at = upper ? vec2(real(1), real(1)) : vec2(real(0), real(0));
  facet.sound = low_x.w > real(0) && high_x.w > real(0) && other.w > real(0);
  return facet;
}

// local: within the square, in its sides.
VG_FUNCTION SurfacePoint point_of_facet(Facet facet, vec2 local, real per_side) {
  vec2 from = local - facet.at;
  vec4 value = facet.corner + from.x * facet.along_x + from.y * facet.along_y;
  SurfacePoint point;
  point.z = value.x;
  point.gradient = vec2(value.y, value.z);
  point.hessian = per_side * vec3(facet.along_x.y, real(0.5) * (facet.along_x.z + facet.along_y.y), facet.along_y.z);
  point.inside = facet.sound;
  return point;
}

// The mesh at a point of the lens's plane.
VG_FUNCTION SurfacePoint facets_point(TABLE_PARAM SurfaceData s, vec2 p) {
  vec2 place = vec2((p.x - s.shape.x) * s.shape.z, (p.y - s.shape.y) * s.shape.z);
  int i = int(clamp(place.x, real(0), real(s.kind.z - 1)));
  int j = int(clamp(place.y, real(0), real(s.kind.w - 1)));
  vec2 local = place - vec2(real(i), real(j));
  SurfacePoint point = point_of_facet(facet_of(TABLE s, i, j, local.x + local.y > real(1)), local, s.shape.z);
  point.inside = point.inside && p.x >= s.domain.x && p.x <= s.domain.y && p.y >= s.domain.z && p.y <= s.domain.w;
  return point;
}

// The part of a ray between two parallel planes: t from x to y, x > y if there is none.
VG_FUNCTION vec2 between_planes(real o, real d, real low, real high, vec2 range) {
  if (abs(d) <= kEpsilon * kEpsilon) {
    return o >= low && o <= high ? range : vec2(real(1), real(0));
  }
  real a = (low - o) / d;
  real b = (high - o) / d;
  return vec2(max(range.x, min(a, b)), min(range.y, max(a, b)));
}

// Where a ray leaves a square along one axis.
VG_FUNCTION real square_end(real origin, int i, real side, real o, real d, real never) {
  if (abs(d) <= kEpsilon * kEpsilon) {
    return never;
  }
  return (origin + real(d > real(0) ? i + 1 : i) * side - o) / d;
}

VG_FUNCTION SurfaceHit facets_hit(TABLE_PARAM SurfaceData s, vec3 o, vec3 d, real semi_diameter) {
  SurfaceHit hit;
  hit.found = false;
  hit.ledge = false;
  hit.unsettled = false;
  hit.steps = -1;
  hit.t = real(0);
  hit.point.inside = false;
  real least = real(-4) * kEpsilon * (abs(o.z) + semi_diameter);  // a start that touches the surface is a hit
  real margin = real(1e-4) * s.shape.w;
  vec2 range = vec2(least, real(16) * (abs(o.z) + semi_diameter));
  range = between_planes(o.x, d.x, s.domain.x, s.domain.y, range);
  range = between_planes(o.y, d.y, s.domain.z, s.domain.w, range);
  range = between_planes(o.z, d.z, s.frame.x - margin, s.frame.y + margin, range);
  if (!(range.y >= range.x)) {
    return hit;
  }
  vec2 step = vec2(d.x * s.shape.z, d.y * s.shape.z);  // in squares a unit of t
  vec2 origin = vec2((o.x - s.shape.x) * s.shape.z, (o.y - s.shape.y) * s.shape.z);
  int i = int(clamp(origin.x + range.x * step.x, real(0), real(s.kind.z - 1)));
  int j = int(clamp(origin.y + range.x * step.y, real(0), real(s.kind.w - 1)));
  real best = real(2) * abs(range.y) + real(1);
  for (int visited = 0; visited < s.kind.z + s.kind.w + 2; ++visited) {
    for (int half_square = 0; half_square < 2; ++half_square) {
      Facet facet = facet_of(TABLE s, i, j, half_square == 1);
      vec2 from = origin - vec2(real(i), real(j)) - facet.at;
      real above = o.z - facet.corner.x - facet.along_x.x * from.x - facet.along_y.x * from.y;
      real slope = d.z - facet.along_x.x * step.x - facet.along_y.x * step.y;
      real t = slope < real(0) ? -above / slope : least - real(1);
      vec2 local = origin - vec2(real(i), real(j)) + t * step;
      // A hair of overlap, so that no ray slips through between triangles.
      real low = real(-1e-4);
      real sum = local.x + local.y;
      bool in_half = half_square == 0 ? local.x >= low && local.y >= low && sum <= real(1) - low
                                      : local.x <= real(1) - low && local.y <= real(1) - low && sum >= real(1) + low;
      if (facet.sound && in_half && t >= least && t < best) {
        best = t;
        hit.point = point_of_facet(facet, local, s.shape.z);
        hit.found = true;
      }
    }
    real end_x = square_end(s.shape.x, i, s.shape.w, o.x, d.x, range.y + real(1));
    real end_y = square_end(s.shape.y, j, s.shape.w, o.y, d.y, range.y + real(1));
    bool along_x = end_x < end_y;
    i += along_x ? (d.x > real(0) ? 1 : -1) : 0;
    j += along_x ? 0 : (d.y > real(0) ? 1 : -1);
    if (hit.found || !(min(end_x, end_y) <= range.y) || i < 0 || j < 0 || i >= s.kind.z || j >= s.kind.w) {
      break;
    }
  }
  hit.t = hit.found ? max(best, real(0)) : real(0);
  return hit;
}
