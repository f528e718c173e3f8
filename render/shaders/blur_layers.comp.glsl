#version 460
#extension GL_GOOGLE_include_directive : require
// Approximate defocus where a blur reaches across depth. What lies in front of the pixel's own point covers it as far as
// each of its points, spread evenly over its own ellipse, adds up to; the rest shows the mean over the pixel's ellipse of
// what lies beside and behind. So nothing sharp bleeds, what a point sends out stays what it is, and where a near edge
// uncovers what no ray has seen, its neighbours stand in.
#include "render/shaders/gather.glsl"
#include "render/shaders/blurred_out.glsl"

layout(binding = 2) uniform usamplerBuffer reaches;
layout(binding = 3) uniform usamplerBuffer list;
#include "render/shaders/listed_tiles.glsl"

// A pixel (level 0), or what lies nearest in a square of 2 pixels (level 1).
Square square_at(ivec2 q, int level, int base) {
  q = clamp(q, ivec2(0), (frame.size.xy - 1) >> level);
  int start = level == 0 ? base : blur_nearest_start(tile_count());
  int width = level == 0 ? pixels_a_row() : blur_level_width(tile_count(), 1);
  uvec4 packed = texelFetch(pixels, start + q.y * width + q.x);
  Square square = unpack_square(packed);
  if (kWide == 0u || level == 0) {
    float depth = uintBitsToFloat(packed.w);
    square.coverage = depth < 0.0 ? 0.0 : 1.0;
    square.nearness = nearness(depth);
  }
  return square;
}

// How far in front of `here` something stands, 0 or 1 and between: by the pixels that the pupil's half sets the two
// apart. A surface may slope by a quarter of that a pixel.
float in_front(float nearer, float here, float distance) {
  return clamp(frame.limits.w * (nearer - here) - kBlurParallax - 0.25 * distance, 0.0, 1.0);
}
float in_front(float nearer, float here, vec2 offset) { return in_front(nearer, here, length(offset)); }

// How a point's light is spread: its ellipse, half a pixel wide and more, the ellipse's determinant, the px^2 it counts as.
struct Spread {
  vec3 ellipse;
  float det, area;
};

Spread spread_of(vec3 s) {
  float b = max(s.x + s.z - major(s), 0.0);
  float widen = max(0.5 - b, 0.0);
  vec3 wide = s + vec3(widen, 0.0, widen);
  float det = max(wide.x * wide.z - wide.y * wide.y, 1e-6);
  return Spread(wide, det, kPi * (det + 1.0 / 12.0));
}

// The part of it that falls on a pixel at `offset`, `distance` away.
float share(Spread s, vec2 offset, float distance) {
  vec2 inner = vec2(s.ellipse.z * offset.x - s.ellipse.y * offset.y, s.ellipse.x * offset.y - s.ellipse.y * offset.x);
  if (kGaussian != 0u) {
    return exp(-2.0 * dot(inner, inner) / (s.det * s.det)) * 2.0 / (kPi * s.det);
  }
  float radius = max(dot(inner, inner), 1e-12);  // its square, times that of det
  float inverse = 1.0 / (radius * s.area);       // one quotient for both
  float inside = s.det * distance * sqrt(inverse * s.area) - distance + 0.5;  // px within the ellipse's edge
  return clamp(distance > 0.0 ? inside : 1.0, 0.0, 1.0) * inverse * radius;
}

// The mean over the pixel's ellipse of what lies at its depth and behind. Of what lies behind the nearest counts most.
vec3 beside_and_behind(Tap centre, float reach, ivec2 p, int base) {
  float here = nearness(centre.depth);
  float minor = centre.ellipse.x + centre.ellipse.z - reach;
  int level = kWide != 0u && minor >= kWideBlur && kRate > 1 ? 1 : 0;
  float side = float(1 << level);
  float step = max(1.0, floor(sqrt(kPi * reach * max(minor, 1.0) / float(kTaps)) / side));
  float cell = side * step;
  vec3 s = shrunk(centre.ellipse, taps_variance(side, cell)) / cell;
  ivec2 at = p >> level;
  vec2 beside = (vec2(p) + 0.5) / side - vec2(at) - 0.5;
  Rows rows = rows_of(s, beside / step);
  ivec2 range = row_range(rows);
  vec4 own = vec4(centre.radiance, 1.0) * 1e-3;
  vec4 behind = vec4(0.0);
  float uncovered = 0.0;
  for (int row = range.x; row <= range.y; ++row) {
    vec2 span = row_span(rows, row);
    ivec2 cells = row_cells(rows, span);
    for (int k = cells.x; k <= cells.y; ++k) {
      ivec2 q = int(step) * ivec2(k, row);
      vec2 offset = (vec2(q) - beside) * side;
      Square tap = square_at(at + q, level, base);
      float whole = cell_weight(rows, span, row, k) * tap.coverage;
      float w = whole * (1.0 - in_front(tap.nearness, here, offset));
      // Where something stands in front, what lies half as far stands in.
      Square between = square_at(at + ivec2(round(0.5 * vec2(q))), level, base);
      float between_seen = between.coverage * (1.0 - in_front(between.nearness, here, 0.5 * offset));
      own += (whole - w) * between_seen * vec4(between.radiance, 1.0);
      float back = w * in_front(here, tap.nearness, offset);
      own += (w - back) * vec4(tap.radiance, 1.0);
      uncovered += back + (w - back) * (1.0 / max(tap.coverage, 0.25) - 1.0);  // behind a square's nearest
      behind += back / (1.0 + kNearestFill * dot(offset, offset)) * vec4(tap.radiance, 1.0);
    }
  }
  uncovered = behind.a > 0.0 ? uncovered : 0.0;
  return (own.rgb + uncovered * behind.rgb / max(behind.a, 1e-6)) / (own.a + uncovered);
}

vec3 small_beside(Tap centre, vec3 radiance, ivec2 p, int base) {
  float here = nearness(centre.depth);
  vec3 mean = radiance;
  for (int k = 0; k < 9; ++k) {
    ivec2 o = ivec2(k % 3 - 1, k / 3 - 1);
    Square tap = square_at(p + o, 0, base);
    float w = tap.coverage * small_weight(centre.ellipse, o) * (1.0 - in_front(tap.nearness, here, vec2(o)));
    mean += w * (tap.radiance - radiance);
  }
  return mean;
}

// Beside a near edge a pixel's several rays have met both sides. Where the near side is blurred, the far side's light is
// taken from a pixel farther from the edge.
vec3 clean_radiance(Tap centre, ivec2 p, int base) {
  float here = nearness(centre.depth);
  vec2 toward = vec2(0.0);
  float blurred = 0.0;
  for (int k = 0; k < 9; ++k) {
    ivec2 o = ivec2(k % 3 - 1, k / 3 - 1);
    Square tap = square_at(p + o, 0, base);
    float w = tap.coverage * in_front(tap.nearness, here, vec2(o));
    toward += w * vec2(o);
    blurred = max(blurred, w * clamp(major(tap.ellipse) - 0.5, 0.0, 1.0));
  }
  if (blurred == 0.0 || toward == vec2(0.0)) {
    return centre.radiance;
  }
  ivec2 away = ivec2(round(-2.0 * toward / max(abs(toward.x), abs(toward.y))));
  Square tap = square_at(p + away, 0, base);
  float w = tap.coverage * (1.0 - in_front(tap.nearness, here, vec2(away)));
  return mix(centre.radiance, tap.radiance, w * blurred);
}

vec4 from_front(Square tap, Spread spread, vec2 offset, float here) {
  float distance = length(offset);
  float w = tap.coverage * in_front(tap.nearness, here, distance) * share(spread, offset, distance);
  return w * vec4(tap.radiance, 1.0);
}

// Of 2 x 2 pixels, radiance times coverage, coverage: row by row over all from where light may come.
void front(vec4 here, float reach, ivec2 corner, int base, inout vec4 a, inout vec4 b, inout vec4 c, inout vec4 d) {
  int level = kWide != 0u && reach >= kWideBlur && kRate > 1 ? 1 : 0;
  float side = float(1 << level);
  float radius = (reach + 1.0) / side + float(1 - level);  // from the square's corner
  float step = max(1.0, ceil(sqrt(kPi / float(2 * kTaps)) * radius));
  ivec2 at = corner >> level;
  float middle = 0.5 * side - 0.5;  // of the square that holds the corner, from the corner's middle
  int rows = reach > 0.0 ? int(radius / step) : -1;
  for (int row = -rows; row <= rows; ++row) {
    float y = float(row) * step;
    int columns = int(sqrt(max(radius * radius - y * y, 0.0)) / step);
    for (int column = -columns; column <= columns; ++column) {
      vec2 place = vec2(float(column) * step, y);
      Square tap = square_at(at + ivec2(place), level, base);
      Spread spread = spread_of(tap.ellipse);
      vec2 offset = place * side + middle;
      a += from_front(tap, spread, offset, here.x);
      b += from_front(tap, spread, offset - vec2(1.0, 0.0), here.y);
      c += from_front(tap, spread, offset - vec2(0.0, 1.0), here.z);
      d += from_front(tap, spread, offset - vec2(1.0, 1.0), here.w);
    }
  }
  float area = side * side * step * step;  // px of a tap
  a *= area;
  b *= area;
  c *= area;
  d *= area;
}

// before: what covers the pixel from in front.
void blur_pixel(ivec2 p, int base, float reach_of_front, vec4 before) {
  Tap centre = tap_at(base + p.y * pixels_a_row() + p.x);
  vec3 mean = centre.radiance;
  if (centre.depth >= 0.0) {
    float reach = major(centre.ellipse);
    if (reach_of_front > 0.0) {
      mean = clean_radiance(centre, p, base);
    }
    if (reach >= frame.limits.x) {
      mean = reach < 1.0 ? small_beside(centre, mean, p, base) : beside_and_behind(centre, reach, p, base);
    }
    before = before.a > 1.0 ? before / before.a : before;
    mean = before.rgb + (1.0 - before.a) * mean;
  }
  leave_blurred((frame.view.x * frame.size.y + p.y) * frame.size.x + p.x, mean);
}

float nearness_at(ivec2 p, int base) {
  p = min(p, frame.size.xy - 1);
  return nearness(uintBitsToFloat(texelFetch(pixels, base + p.y * pixels_a_row() + p.x).w));
}

// An invocation takes 2 x 2 pixels, for which it fetches and looks at once what may lie in front of them; a workgroup
// takes kNarrowTiles tiles.
void main() {
  const int side = kBlurTile / 2;
  int lane = int(gl_LocalInvocationIndex);
  uint place = kNarrowTiles * listed_place() + uint(lane / (side * side));
  ivec2 tile = listed_tile(place);
  ivec2 corner = kBlurTile * tile + 2 * ivec2(lane % side, lane / side % side);
  ivec2 size = frame.size.xy;
  if (!is_listed(place) || any(greaterThanEqual(corner, size))) {
    return;
  }
  int base = first_pixel();
  vec2 before_tile = TILE_REACH(tile);
  vec4 here = vec4(nearness_at(corner, base), nearness_at(corner + ivec2(1, 0), base),
                   nearness_at(corner + ivec2(0, 1), base), nearness_at(corner + ivec2(1, 1), base));
  // The nearest itself has nothing in front of it.
  vec4 covered = step(vec4(kBlurParallax), frame.limits.w * (before_tile.y - here));
  vec4 a = vec4(0.0);
  vec4 b = vec4(0.0);
  vec4 c = vec4(0.0);
  vec4 d = vec4(0.0);
  front(here, dot(covered, vec4(1.0)) > 0.0 ? before_tile.x : 0.0, corner, base, a, b, c, d);
  for (int k = 0; k < 4; ++k) {
    ivec2 p = corner + ivec2(k & 1, k >> 1);
    vec4 before = k < 2 ? (k == 0 ? a : b) : (k == 2 ? c : d);
    float is_covered = k < 2 ? (k == 0 ? covered.x : covered.y) : (k == 2 ? covered.z : covered.w);
    if (all(lessThan(p, size))) {
      blur_pixel(p, base, is_covered * before_tile.x, before);
    }
  }
}
