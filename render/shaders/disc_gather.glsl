// The mean over an ellipse in a picture of one depth. Taps of a wide blur are means over squares of pixels, so that few
// of them leave no holes. The includer declares `levels`.

vec4 level_tap(ivec2 q, int level, int base) {
  if (level == 0) {
    uvec4 p = texelFetch(pixels, base + q.y * frame.size.x + q.x);
    return vec4(unpackHalf2x16(p.x), unpackHalf2x16(p.y).x, uintBitsToFloat(p.w) < 0.0 ? 0.0 : 1.0);
  }
  uvec2 p = texelFetch(levels, blur_level_start(tile_count(), level) + q.y * blur_level_width(tile_count(), level) + q.x).xy;
  return vec4(unpackHalf2x16(p.x), unpackHalf2x16(p.y));
}

// The finest squares that make do with the taps, none wider than the minor semi-axis.
int level_of(float area, float minor, int least) {
  float squares = 0.5 * log2(area / float(kTaps));
  return clamp(int(round(min(squares, log2(max(minor, 1.0))))), least, 3);
}

// Around `at` (px), over squares of the level; variance: px^2, what else widens the picture of a point.
// a: how many squares it is the sum of.
vec4 disc_sum(vec3 ellipse, float area, vec2 at, int level, float variance, int base) {
  float side = float(1 << level);
  float step = max(1.0, floor(0.5 * sqrt(area / float(kTaps)) / side));  // squares from tap to tap, where no level is left
  float cell = side * step;
  // The width of a square, and that of a cell as rows of cells cover the ellipse.
  vec3 s = shrunk(ellipse, variance + (side * side - 1.0 + cell * cell) / 12.0) / cell;
  ivec2 middle = ivec2(floor(at / side));
  Rows rows = rows_of(s, (at / side - vec2(middle) - 0.5) / step);
  ivec2 last = (frame.size.xy - 1) >> level;
  ivec2 range = row_range(rows);
  vec4 sum = vec4(0.0);
  for (int row = range.x; row <= range.y; ++row) {
    vec2 span = row_span(rows, row);
    ivec2 cells = cells_between(span.x, span.y);
    for (int k = cells.x; k <= cells.y; ++k) {
      vec4 tap = level_tap(clamp(middle + int(step) * ivec2(k, row), ivec2(0), last), level, base);
      sum += cell_weight(rows, span, row, k) * tap.w * vec4(tap.rgb, 1.0);
    }
  }
  return sum;
}

float ellipse_area(float major, float minor) { return kPi * major * max(minor, 1.0); }
