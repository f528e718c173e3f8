// The mean over an ellipse in a picture of one depth. Taps of a wide blur are means over squares of pixels, so that few
// of them leave no holes. Of a picture that wide blurs gather from (kWide).

// The finest squares that make do with the taps, none wider than the minor semi-axis.
int level_of(float area, float minor) {
  float squares = 0.5 * log2(area / float(kTaps));
  return clamp(int(round(min(squares, log2(max(minor, 1.0))))), 0, 3);
}

// Around `at` (px), over squares of the level; variance: px^2, what else widens the picture of a point.
// a: how many squares it is the sum of.
vec4 disc_sum(vec3 ellipse, float area, vec2 at, int level, float variance) {
  float side = float(1 << level);
  float step = max(1.0, floor(0.5 * sqrt(area / float(kTaps)) / side));  // squares from tap to tap, where no level is left
  float cell = side * step;
  vec3 s = shrunk(ellipse, variance + taps_variance(side, cell)) / cell;
  ivec2 middle = ivec2(floor(at / side));
  Rows rows = rows_of(s, (at / side - vec2(middle) - 0.5) / step);
  ivec2 last = (frame.size.xy - 1) >> level;
  int start = blur_level_start(tile_count(), level);
  int width = blur_level_width(tile_count(), level);
  ivec2 range = row_range(rows);
  vec4 sum = vec4(0.0);
  for (int row = range.x; row <= range.y; ++row) {
    vec2 span = row_span(rows, row);
    ivec2 cells = row_cells(rows, span);
    int at_row = start + clamp(middle.y + int(step) * row, 0, last.y) * width;
    for (int k = cells.x; k <= cells.y; ++k) {
      Tap tap = tap_at(at_row + clamp(middle.x + int(step) * k, 0, last.x));
      float w = tap.depth < 0.0 ? 0.0 : cell_weight(rows, span, row, k);
      sum += w * vec4(tap.radiance, 1.0);
    }
  }
  return sum;
}

float ellipse_area(float major, float minor) { return kPi * major * max(minor, 1.0); }
