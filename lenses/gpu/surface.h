// Every lens surface as a height field z = sag(x, y): value, gradient and second derivatives. Metres.
//
// In this form the vertex sheet is the only sheet (no phantom hit on a torus's far side), a curvature of zero is no
// special case, and the ray-transfer matrix needs nothing but the derivatives.
// Sources: do Carmo 1976 (fundamental forms of a graph); de Boor 1978 (B-splines; cells here hold power-basis
// coefficients computed in double on the host).

const int kPlane = 0;
const int kSphere = 1;
const int kConic = 2;
const int kTorus = 3;
const int kBsplineHeightField = 4;
const int kBsplineSurface = 5;
const int kEvenBspline = 6;      // a height field whose cells are all of one size
const uint kShapeBits = 0x67fu;  // of KINDS: the shapes
const int kPlaced = 7;           // of KINDS: some surface is placed
const int kSegmented = 8;        // of KINDS: some surface has a segment
const int kFacets = 9;           // facets.h: stands for another surface, placement included
const int kBezier = 10;          // bezier.h: likewise

const int kLookupSize = 32;  // inverse map of a parametric surface: kLookupSize^2 start values of (u, v)

struct SurfaceData {
  vec4 shape;   // even spline: where its cells begin and 1/(their size), along u and v; mesh: least x, least y, 1/side,
                // side of its squares; else curvature (torus: of the revolved direction), curvature of the profile,
                // conic constant, 1/(scale of even terms)^2
  vec4 frame;   // cosine and sine of the axis of the revolved direction; sag and curvature of the first guess; mesh:
                // least and greatest z
  vec4 domain;  // x0, x1, y0, y1 of a patch (parametric: of its bounding box)
  ivec4 kind;   // kind, number of even terms, cells along u, cells along v; Bezier: nodes of the tree in their place
  ivec4 offset;  // into the table: coefficients, breaks along u, breaks along v, inverse lookup; Bezier: patches, tree
  vec4 shift;    // of a placed surface: decentration, height, 1; else 0
  vec4 slope;    // of a placed surface: its slope, -, -
  ivec4 parts;   // into the table: the segment's surface and boundary; the boundary's edges, 0 without a segment; KINDS
                 // of base and segment together
};

struct SurfacePoint {
  real z;
  vec2 gradient;
  vec3 hessian;  // z_xx, z_xy, z_yy
  bool inside;   // the surface exists at this (x, y)
};

// Where a ray meets a surface.
struct SurfaceHit {
  bool found;
  bool ledge;      // not found, as the ray ends in the wall between a segment and its base, before t
  bool unsettled;  // not found, and not searched for any longer (HURRIED)
  int steps;       // of Newton's method; -1 where another search or a closed form found it
  real t;
  SurfacePoint point;
};

VG_FUNCTION SurfacePoint conic_point(TABLE_PARAM KINDS_PARAM SurfaceData s, vec2 p) {
  real c = s.shape.x;
  real k1 = real(1) + s.shape.z;
  real r2 = dot(p, p);
  real under = real(1) - k1 * c * c * r2;
  bool inside = under > real(0);
  real q = sqrt(max(under, kEpsilon));
  real f = c * r2 / (real(1) + q);  // F(r^2), its first and second derivative by r^2
  real f1 = real(0.5) * c / q;
  real f2 = real(0.25) * c * c * c * k1 / (q * q * q);
  if (KIND_USED(kConic) && s.kind.y > 0) {
    // Even terms in w = r^2 / R^2, so that a coefficient of any order stays within float's range.
    real scale = s.shape.w;
    real w = r2 * scale;
    real e = real(0);
    real e1 = real(0);
    real e2 = real(0);
    for (int i = s.kind.y - 1; i >= 0; --i) {
      e2 = e2 * w + real(2) * e1;
      e1 = e1 * w + e;
      e = e * w + TABLE_AT(s.offset.x + i).x;
    }
    // e(w) = a4 + a6 w + ... multiplies w^2.
    f += e * w * w;
    f1 += (e1 * w * w + real(2) * e * w) * scale;
    f2 += (e2 * w * w + real(4) * e1 * w + real(2) * e) * scale * scale;
  }
  SurfacePoint point;
  point.z = f;
  point.gradient = real(2) * f1 * p;
  point.hessian =
      vec3(real(2) * f1 + real(4) * f2 * p.x * p.x, real(4) * f2 * p.x * p.y, real(2) * f1 + real(4) * f2 * p.y * p.y);
  point.inside = inside;
  return point;
}

// The profile of curvature c_v is turned about the line parallel to v through (u = 0, z = 1/c_u). With
// a = 1 - c_u z and b = 1 - c_u w(v) the surface is a^2 + (c_u u)^2 = b^2, a > 0: tyre and barrel alike.
VG_FUNCTION SurfacePoint torus_point(SurfaceData s, vec2 p) {
  real cu = s.shape.x;
  real cv = s.shape.y;
  real u = s.frame.x * p.x + s.frame.y * p.y;
  real v = s.frame.x * p.y - s.frame.y * p.x;
  real under_v = real(1) - cv * cv * v * v;
  real m = sqrt(max(under_v, kEpsilon));
  real w = cv * v * v / (real(1) + m);
  real w1 = cv * v / m;
  real w2 = cv / (m * m * m);
  real b = real(1) - cu * w;
  real c = cu / max(b, kEpsilon);
  real under_u = real(1) - c * c * u * u;
  real n = sqrt(max(under_u, kEpsilon));
  real a = max(b, kEpsilon) * n;
  real zu = cu * u / a;
  real zv = b * w1 / a;
  real zuu = cu * (real(1) + zu * zu) / a;
  real zuv = cu * zu * zv / a;
  real zvv = (b * w2 + cu * (zv * zv - w1 * w1)) / a;
  SurfacePoint point;
  point.z = w + c * u * u / (real(1) + n);
  real cs = s.frame.x;
  real sn = s.frame.y;
  point.gradient = vec2(cs * zu - sn * zv, sn * zu + cs * zv);
  point.hessian =
      vec3(cs * cs * zuu - real(2) * cs * sn * zuv + sn * sn * zvv, cs * sn * (zuu - zvv) + (cs * cs - sn * sn) * zuv,
           sn * sn * zuu + real(2) * cs * sn * zuv + cs * cs * zvv);
  point.inside = under_v > real(0) && b > real(0) && under_u > real(0);
  return point;
}

// breaks[i] = (x_i, 1/(x_i+1 - x_i), x_i+1, cells/(x_last - x_first)). Half-open cells; the last one is closed, and
// both end cells extend outwards so that an iteration may leave the patch and come back.
VG_FUNCTION int find_cell(TABLE_PARAM int breaks, int cells, real x) {
  vec4 first = TABLE_AT(breaks);
  real guess = clamp((x - first.x) * first.w, real(0), real(cells - 1));
  int i = int(guess);
  for (int step = 0; step < cells; ++step) {
    vec4 b = TABLE_AT(breaks + i);
    int next = x < b.x ? i - 1 : (x >= b.z ? i + 1 : i);
    next = next < 0 ? 0 : (next > cells - 1 ? cells - 1 : next);
    if (next == i) {
      break;
    }
    i = next;
  }
  return i;
}

// One bicubic cell in power basis; rows by power of the second coordinate.
struct Cell {
  vec4 r0;
  vec4 r1;
  vec4 r2;
  vec4 r3;
};

VG_FUNCTION Cell cell_at(TABLE_PARAM int at) {
  Cell cell;
  cell.r0 = TABLE_AT(at);
  cell.r1 = TABLE_AT(at + 1);
  cell.r2 = TABLE_AT(at + 2);
  cell.r3 = TABLE_AT(at + 3);
  return cell;
}

// Value, first and second derivatives in cell units.
struct CellValue {
  real f;
  vec2 d;
  vec3 dd;
};

VG_FUNCTION CellValue cell_value(Cell cell, real x, real y) {
  vec4 r0 = cell.r0;
  vec4 r1 = cell.r1;
  vec4 r2 = cell.r2;
  vec4 r3 = cell.r3;
  real three = real(3);
  real two = real(2);
  real six = real(6);
  vec4 a = vec4(((r0.w * x + r0.z) * x + r0.y) * x + r0.x, ((r1.w * x + r1.z) * x + r1.y) * x + r1.x,
                ((r2.w * x + r2.z) * x + r2.y) * x + r2.x, ((r3.w * x + r3.z) * x + r3.y) * x + r3.x);
  vec4 b = vec4((three * r0.w * x + two * r0.z) * x + r0.y, (three * r1.w * x + two * r1.z) * x + r1.y,
                (three * r2.w * x + two * r2.z) * x + r2.y, (three * r3.w * x + two * r3.z) * x + r3.y);
  vec4 c = vec4(six * r0.w * x + two * r0.z, six * r1.w * x + two * r1.z, six * r2.w * x + two * r2.z,
                six * r3.w * x + two * r3.z);
  CellValue value;
  value.f = ((a.w * y + a.z) * y + a.y) * y + a.x;
  value.d = vec2(((b.w * y + b.z) * y + b.y) * y + b.x, (three * a.w * y + two * a.z) * y + a.y);
  value.dd =
      vec3(((c.w * y + c.z) * y + c.y) * y + c.x, (three * b.w * y + two * b.z) * y + b.y, six * a.w * y + two * a.z);
  return value;
}

// size: of the cell, inverse. Whether the surface exists there is left to the caller.
VG_FUNCTION SurfacePoint cell_point(CellValue value, vec2 size) {
  SurfacePoint point;
  point.z = value.f;
  point.gradient = value.d * size;
  point.hessian = vec3(value.dd.x * size.x * size.x, value.dd.y * size.x * size.y, value.dd.z * size.y * size.y);
  point.inside = true;
  return point;
}

VG_FUNCTION SurfacePoint bspline_height_point(TABLE_PARAM SurfaceData s, vec2 p) {
  int i = find_cell(TABLE s.offset.y, s.kind.z, p.x);
  int j = find_cell(TABLE s.offset.z, s.kind.w, p.y);
  vec4 bx = TABLE_AT(s.offset.y + i);
  vec4 by = TABLE_AT(s.offset.z + j);
  Cell cell = cell_at(TABLE s.offset.x + 4 * (i * s.kind.w + j));
  SurfacePoint point = cell_point(cell_value(cell, (p.x - bx.x) * bx.y, (p.y - by.x) * by.y), vec2(bx.y, by.y));
  point.inside = p.x >= s.domain.x && p.x <= s.domain.y && p.y >= s.domain.z && p.y <= s.domain.w;
  return point;
}

// The same where all cells are of one size: which one and where in it is known without a look at the breaks.
VG_FUNCTION SurfacePoint even_bspline_point(TABLE_PARAM SurfaceData s, vec2 p) {
  vec2 cell = vec2((p.x - s.shape.x) * s.shape.y, (p.y - s.shape.z) * s.shape.w);
  int i = int(clamp(cell.x, real(0), real(s.kind.z - 1)));
  int j = int(clamp(cell.y, real(0), real(s.kind.w - 1)));
  CellValue value = cell_value(cell_at(TABLE s.offset.x + 4 * (i * s.kind.w + j)), cell.x - real(i), cell.y - real(j));
  SurfacePoint point = cell_point(value, vec2(s.shape.y, s.shape.w));
  point.inside = p.x >= s.domain.x && p.x <= s.domain.y && p.y >= s.domain.z && p.y <= s.domain.w;
  return point;
}

// A parametric patch (u, v) -> (x, y, z) read as a height field: (u, v) is solved for by Newton's method from a
// tabulated start; the chain rule turns derivatives by (u, v) into derivatives by (x, y).
VG_FUNCTION SurfacePoint bspline_surface_point(TABLE_PARAM SurfaceData s, vec2 p) {
  vec4 u_first = TABLE_AT(s.offset.y);
  vec4 u_last = TABLE_AT(s.offset.y + s.kind.z - 1);
  vec4 v_first = TABLE_AT(s.offset.z);
  vec4 v_last = TABLE_AT(s.offset.z + s.kind.w - 1);
  vec2 low = vec2(u_first.x, v_first.x);
  vec2 high = vec2(u_last.z, v_last.z);
  real size = real(kLookupSize);
  int ix = int(clamp((p.x - s.domain.x) / (s.domain.y - s.domain.x) * size, real(0), size - real(1)));
  int iy = int(clamp((p.y - s.domain.z) / (s.domain.w - s.domain.z) * size, real(0), size - real(1)));
  vec4 start = TABLE_AT(s.offset.w + ix * kLookupSize + iy);
  vec2 w = vec2(start.x, start.y);
  vec2 span = high - low;
  vec2 reach = real(0.05) * span;  // how far an iterate may leave the patch
  CellValue x;
  CellValue y;
  CellValue z;
  vec2 xd = vec2(real(1), real(0));
  vec2 yd = vec2(real(0), real(1));
  vec2 scale = vec2(real(1), real(1));
  real det = real(1);
  vec2 miss = vec2(real(0), real(0));
  bool more = true;
  for (int step = 0; step < 16; ++step) {
    int i = find_cell(TABLE s.offset.y, s.kind.z, w.x);
    int j = find_cell(TABLE s.offset.z, s.kind.w, w.y);
    vec4 bu = TABLE_AT(s.offset.y + i);
    vec4 bv = TABLE_AT(s.offset.z + j);
    real cu = (w.x - bu.x) * bu.y;
    real cv = (w.y - bv.x) * bv.y;
    int at = s.offset.x + 12 * (i * s.kind.w + j);
    x = cell_value(cell_at(TABLE at), cu, cv);
    y = cell_value(cell_at(TABLE at + 4), cu, cv);
    z = cell_value(cell_at(TABLE at + 8), cu, cv);
    scale = vec2(bu.y, bv.y);
    xd = x.d * scale;
    yd = y.d * scale;
    det = xd.x * yd.y - xd.y * yd.x;
    miss = p - vec2(x.f, y.f);
    if (!more || !(abs(det) > real(0))) {
      break;
    }
    vec2 delta = vec2(yd.y * miss.x - xd.y * miss.y, xd.x * miss.y - yd.x * miss.x) / det;
    vec2 next = clamp(w + delta, low - reach, high + reach);
    vec2 moved = abs(next - w) / span;
    more = max(moved.x, moved.y) > real(4) * kEpsilon;  // once more at the solution, for its derivatives
    w = next;
  }
  SurfacePoint point;
  real guard = abs(det) > real(0) ? det : real(1);
  vec2 zd = z.d * scale;
  vec2 g = vec2(zd.x * yd.y - zd.y * yd.x, zd.y * xd.x - zd.x * xd.y) / guard;
  // Second derivatives of z minus what the curvature of x(u, v) and y(u, v) contributes.
  vec3 ss = vec3(scale.x * scale.x, scale.x * scale.y, scale.y * scale.y);
  vec3 r = (z.dd - g.x * x.dd - g.y * y.dd) * ss;
  vec2 ux = vec2(yd.y, -yd.x) / guard;  // u_x, v_x
  vec2 uy = vec2(-xd.y, xd.x) / guard;  // u_y, v_y
  // A point off the patch is met along the tangent plane.
  point.z = z.f + dot(g, miss);
  point.gradient = g;
  point.hessian = vec3(r.x * ux.x * ux.x + real(2) * r.y * ux.x * ux.y + r.z * ux.y * ux.y,
                       r.x * ux.x * uy.x + r.y * (ux.x * uy.y + ux.y * uy.x) + r.z * ux.y * uy.y,
                       r.x * uy.x * uy.x + real(2) * r.y * uy.x * uy.y + r.z * uy.y * uy.y);
  vec2 slack = real(16) * kEpsilon * span;
  bool on_patch = w.x >= low.x - slack.x && w.x <= high.x + slack.x && w.y >= low.y - slack.y &&
                  w.y <= high.y + slack.y && abs(det) > real(0);
  point.inside = on_patch && dot(miss, miss) < real(1e-12);
  return point;
}
