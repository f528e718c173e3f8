// A surface as it sits in the lens: its shape, moved and tilted, with or without a segment. After surface.h.

// The surface's shape in its own axes.
VG_FUNCTION SurfacePoint shape_point(TABLE_PARAM KINDS_PARAM SurfaceData s, vec2 p) {
  if (IS_KIND(s, kFacets)) {
    return facets_point(TABLE s, p);
  }
  if (IS_KIND(s, kBezier)) {
    return bezier_point(TABLE s, p);
  }
  if (IS_KIND(s, kEvenBspline)) {
    return even_bspline_point(TABLE s, p);
  }
  if (IS_KIND(s, kBsplineHeightField)) {
    return bspline_height_point(TABLE s, p);
  }
  if (IS_KIND(s, kTorus)) {
    return torus_point(s, p);
  }
  if (IS_KIND(s, kBsplineSurface)) {
    return bspline_surface_point(TABLE s, p);
  }
  return conic_point(TABLE KINDS(kinds) s, p);  // plane and sphere are conics
}

// A point of the shape, found at p - decentration, as a point of the placed surface at p.
VG_FUNCTION SurfacePoint placed(SurfaceData s, SurfacePoint point, vec2 p) {
  vec2 slope = vec2(s.slope.x, s.slope.y);
  point.z += dot(slope, p) + s.shift.z;
  point.gradient += slope;
  return point;
}

VG_FUNCTION SurfacePoint placed_point(TABLE_PARAM KINDS_PARAM SurfaceData s, vec2 p) {
  vec2 q = p;
  if (IS_PLACED(s)) {
    q -= vec2(s.shift.x, s.shift.y);
  }
  SurfacePoint point = shape_point(TABLE KINDS(kinds) s, q);
  if (IS_PLACED(s)) {
    point = placed(s, point, p);
  }
  return point;
}

// The second surface of a segmented one, as surface_model.cpp lays it down.
VG_FUNCTION SurfaceData segment_surface(TABLE_PARAM SurfaceData s) {
  int at = s.parts.x;
  SurfaceData segment;
  segment.shape = TABLE_AT(at);
  segment.frame = TABLE_AT(at + 1);
  segment.domain = TABLE_AT(at + 2);
  segment.kind = ivec4(TABLE_AT(at + 3));
  segment.offset = ivec4(TABLE_AT(at + 4));
  segment.shift = TABLE_AT(at + 5);
  segment.slope = TABLE_AT(at + 6);
  segment.parts = ivec4(0, 0, 0, 0);
  return segment;
}

// Even-odd rule; an edge is (x, dx/dy, y, y of its other end). Neighbouring edges share their end's y to the last bit,
// so that a point on a level with a corner is counted once.
VG_FUNCTION bool in_segment(TABLE_PARAM SurfaceData s, vec2 p) {
  bool inside = false;
  for (int i = 0; i < s.parts.z; ++i) {
    vec4 edge = TABLE_AT(s.parts.y + i);
    bool level = (edge.z > p.y) != (edge.w > p.y);
    inside = inside != (level && p.x < edge.x + (p.y - edge.z) * edge.y);
  }
  return inside;
}

// The surface in lens axes.
VG_FUNCTION SurfacePoint surface_point(TABLE_PARAM KINDS_PARAM SurfaceData s, vec2 p) {
  SurfaceData one = s;
  if (IS_SEGMENTED(s) && in_segment(TABLE s, p)) {
    one = segment_surface(TABLE s);
  }
  return placed_point(TABLE KINDS(kinds) one, p);
}
