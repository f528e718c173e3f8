#version 460
#extension GL_GOOGLE_include_directive : require
// Approximate defocus in the listed tiles, where all that a blur reaches lies at one depth and no blur is wide: means over
// ellipses whose taps are all pixels. An invocation takes 2 x 2 pixels, for which it fetches and weighs each tap once: at
// one depth an ellipse hardly changes from pixel to pixel. A workgroup takes kNarrowTiles tiles.
#include "render/shaders/gather.glsl"
#include "render/shaders/blurred_out.glsl"

layout(binding = 2) uniform usamplerBuffer list;
#include "render/shaders/listed_tiles.glsl"

// Rows of weights around a pixel: a row's cells count by how much of them lies within its half span of where its middle
// leans to, times its strength.
struct Weights {
  float scale, top, inverse_top;  // of a disc's rows
  float lean, softness, inverse_softness;
  vec2 half_spans;  // of a blur within the pixel, rows 0 and 1
  vec2 strengths;
  bool small;
  int last_row;
};

// The nine weights of small_weight() as rows: the diagonal that has a weight goes on from the row's middle.
Weights small_weights(vec3 ellipse) {
  vec3 middle_side = vec3(small_weight(ellipse, ivec2(1, 0)), small_weight(ellipse, ivec2(0, 1)), 0.0);
  float falling = small_weight(ellipse, ivec2(1, 1));
  float rising = small_weight(ellipse, ivec2(1, -1));
  middle_side.z = falling + rising;  // one of them is none
  float middle = 1.0 - 2.0 * (middle_side.x + middle_side.y + middle_side.z);
  float most = max(middle_side.y, middle_side.z);
  float of_most = most > 0.0 ? min(middle_side.y, middle_side.z) / most : 0.0;
  float lean = 0.5 * (middle_side.y >= middle_side.z ? of_most : 2.0 - of_most);
  return Weights(0.0, 2.0, 0.0, rising > 0.0 ? -lean : lean, 1.0, 1.0,
                 vec2(0.5 + middle_side.x / middle, 0.5 + 0.5 * of_most), vec2(middle, most), true, 1);
}

Weights weights_of(vec3 ellipse) {
  Rows rows = rows_of(ellipse, vec2(0.0));
  Weights disc = Weights(rows.width * rows.top, rows.top, rows.inverse_top, rows.lean, rows.softness, rows.inverse_softness,
                         vec2(0.0), vec2(0.0), false, row_range(rows).y);
  Weights nine = small_weights(ellipse);
  bool small = major(ellipse) < 1.0;
  disc.top = small ? nine.top : disc.top;
  disc.lean = small ? nine.lean : disc.lean;
  disc.softness = small ? nine.softness : disc.softness;
  disc.inverse_softness = small ? nine.inverse_softness : disc.inverse_softness;
  disc.half_spans = nine.half_spans;
  disc.strengths = nine.strengths;
  disc.small = small;
  disc.last_row = small ? 1 : disc.last_row;
  return disc;
}

struct Row {
  vec2 ends;     // where its weights rise and fall, in softnesses
  float strength;
  ivec2 cells;
};

Row row_of(Weights w, int row, float above, float covered) {
  int apart = abs(row);
  float half_span = w.scale * (above - covered);
  half_span = w.small ? (apart == 0 ? w.half_spans.x : w.half_spans.y) : half_span;
  float strength = w.small ? (apart == 0 ? w.strengths.x : w.strengths.y) : 1.0;
  float middle = row_middle(float(row), w.top, w.lean);
  float beyond = half_span + 0.5 * w.softness - 0.5;
  bool within = apart <= w.last_row;
  return Row((vec2(half_span, -half_span) - middle) * w.inverse_softness + 0.5, within ? strength : 0.0,
             within ? cells_between(middle - beyond, middle + beyond) : ivec2(99, -99));
}

// A software device takes three instructions for min and max, one for each of these.
float clamped(float x) {
  float low = x < 1.0 ? x : 1.0;
  return low > 0.0 ? low : 0.0;
}

float weight(Row row, float along) {
  return row.strength * (clamped(row.ends.x + along) - clamped(row.ends.y + along));
}

// a: 1, or 0 for the rim.
vec4 seen_at(int at) {
  Tap tap = tap_at(at);
  float seen = tap.depth < 0.0 ? 0.0 : 1.0;
  return vec4(seen * tap.radiance, seen);
}


void gather(Weights w, ivec2 corner, int base, inout vec4 a, inout vec4 b, inout vec4 c, inout vec4 d) {
  ivec2 last = frame.size.xy - 1;
  float covered = half_widths((-float(w.last_row) - 0.5) * w.inverse_top);
  Row upper = Row(vec2(0.0), 0.0, ivec2(99, -99));
  for (int row = -w.last_row; row <= w.last_row + 1; ++row) {
    float above = half_widths((float(row) + 0.5) * w.inverse_top);
    Row lower = row_of(w, row, above, covered);
    covered = above;
    int from = min(upper.cells.x, lower.cells.x);
    int to = max(upper.cells.y, lower.cells.y) + 1;
    int at_row = base + clamp(corner.y + row, 0, last.y) * frame.size.x;
    float of_first = 0.0;
    float of_second = 0.0;
    for (int k = from; k <= to; ++k) {
      vec4 tap = seen_at(at_row + clamp(corner.x + k, 0, last.x));
      float along = float(k) * w.inverse_softness;
      b += of_first * tap;
      d += of_second * tap;
      of_first = weight(lower, along);
      of_second = weight(upper, along);
      a += of_first * tap;
      c += of_second * tap;
    }
    upper = lower;
  }
}

void leave(int at, bool inside, Tap own, vec4 sum) {
  bool blurred = own.depth >= 0.0 && major(own.ellipse) >= frame.limits.x && sum.a > 0.0;
  if (inside) {
    leave_blurred(at, blurred ? sum.rgb * (1.0 / sum.a) : own.radiance);
  }
}

void main() {
  const int side = kBlurTile / 2;
  int lane = int(gl_LocalInvocationIndex);
  uint place = kNarrowTiles * listed_place() + uint(lane / (side * side));
  ivec2 size = frame.size.xy;
  ivec2 corner = kBlurTile * listed_tile(place) + 2 * ivec2(lane % side, lane / side % side);
  if (!is_listed(place) || any(greaterThanEqual(corner, size))) {
    return;
  }
  int base = frame.view.x * size.x * size.y;
  bvec2 inside = lessThan(corner + 1, size);
  int at = base + corner.y * size.x + corner.x;
  int across = inside.x ? 1 : 0;
  int down = inside.y ? size.x : 0;
  Tap own_a = tap_at(at);
  Tap own_b = tap_at(at + across);
  Tap own_c = tap_at(at + down);
  Tap own_d = tap_at(at + down + across);
  vec4 seen = vec4(own_a.depth < 0.0 ? 0.0 : 1.0, own_b.depth < 0.0 ? 0.0 : 1.0, own_c.depth < 0.0 ? 0.0 : 1.0,
                   own_d.depth < 0.0 ? 0.0 : 1.0);
  vec3 ellipse = (seen.x * own_a.ellipse + seen.y * own_b.ellipse + seen.z * own_c.ellipse + seen.w * own_d.ellipse) /
                 max(dot(seen, vec4(1.0)), 1.0);
  vec4 a = vec4(0.0);
  vec4 b = vec4(0.0);
  vec4 c = vec4(0.0);
  vec4 d = vec4(0.0);
  gather(weights_of(ellipse), corner, base, a, b, c, d);
  leave(at, true, own_a, a);
  leave(at + across, inside.x, own_b, b);
  leave(at + down, inside.y, own_c, c);
  leave(at + down + across, inside.x && inside.y, own_d, d);
}
