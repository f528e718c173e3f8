#version 460
#extension GL_GOOGLE_include_directive : require
// Approximate defocus in the listed tiles, where all that a blur reaches lies at one depth and no blur is wide: the mean
// over the pixel's own ellipse, whose taps are all pixels. An ellipse is symmetric, so two taps share each weight.
#include "render/shaders/gather.glsl"
#include "render/shaders/blurred_out.glsl"

layout(binding = 2) uniform usamplerBuffer list;
#include "render/shaders/listed_tiles.glsl"

// Two pixels as a sum; a: how many of them are no rim.
vec4 pair_at(int one, int other) {
  Tap a = tap_at(one);
  Tap b = tap_at(other);
  float a_seen = a.depth < 0.0 ? 0.0 : 1.0;
  float b_seen = b.depth < 0.0 ? 0.0 : 1.0;
  return vec4(a_seen * a.radiance + b_seen * b.radiance, a_seen + b_seen);
}

// turns: 0 where another lane's pixel is meant, so that a device that runs both sides of branches ends early.
vec3 small_mean(Tap centre, ivec2 p, int base, int turns) {
  vec3 mean = centre.radiance;
  ivec2 last = frame.size.xy - 1;
  for (int k = 0; k < turns; ++k) {
    ivec2 o = ivec2(k < 2 ? 1 - k : 1, k == 3 ? -1 : min(k, 1));  // (1, 0), (0, 1), (1, 1), (1, -1)
    ivec2 q = min(p + o, last);
    ivec2 r = max(p - o, ivec2(0));
    r.y = min(r.y, last.y);  // o.y may be -1
    q.y = max(q.y, 0);
    vec4 taps = pair_at(base + q.y * frame.size.x + q.x, base + r.y * frame.size.x + r.x);
    mean += small_weight(centre.ellipse, o) * (taps.rgb - taps.a * centre.radiance);
  }
  return mean;
}

vec4 narrow_sum(vec3 ellipse, ivec2 p, int base) {
  Rows rows = rows_of(ellipse, vec2(0.0));
  int last_row = row_range(rows).y;
  ivec2 last = frame.size.xy - 1;
  vec4 sum = vec4(0.0);
  float scale = rows.width * rows.top;
  float above = half_widths(0.5 * rows.inverse_top);
  float covered = -above;
  for (int row = 0; row <= last_row; ++row) {
    float half_span = scale * (above - covered);
    covered = above;
    above = half_widths((float(row) + 1.5) * rows.inverse_top);  // here, as a processor has time for it
    float middle = rows.lean * float(row);
    float beyond = half_span + 0.5 * rows.softness - 0.5;
    ivec2 cells = cells_between(middle - beyond, middle + beyond);
    float from = (half_span - middle) * rows.inverse_softness + 0.5;
    float to = (-half_span - middle) * rows.inverse_softness + 0.5;
    int down = base + min(p.y + row, last.y) * frame.size.x;
    int up = base + max(p.y - row, 0) * frame.size.x;
    vec4 of_row = vec4(0.0);
    for (int k = cells.x; k <= cells.y; ++k) {
      float along = float(k) * rows.inverse_softness;
      float w = clamp(from + along, 0.0, 1.0) - clamp(to + along, 0.0, 1.0);
      of_row += w * pair_at(down + clamp(p.x + k, 0, last.x), up + clamp(p.x - k, 0, last.x));
    }
    sum += (row == 0 ? 0.5 : 1.0) * of_row;  // the middle row's pairs come twice
  }
  return sum;
}

void main() {
  ivec2 size = frame.size.xy;
  int base = frame.view.x * size.x * size.y;
  ivec2 p = listed_pixel();
  if (p.x >= size.x || p.y >= size.y) {
    return;
  }
  Tap centre = tap_at(base + p.y * size.x + p.x);
  float reach = major(centre.ellipse);
  // The rim stays where it is, and what is in focus stays as it is.
  bool blurred = centre.depth >= 0.0 && reach >= frame.limits.x;
  vec3 mean = small_mean(centre, p, base, blurred && reach < 1.0 ? 4 : 0);
  if (blurred && reach >= 1.0) {
    vec4 sum = narrow_sum(centre.ellipse, p, base);
    mean = sum.a > 0.0 ? sum.rgb / sum.a : mean;
  }
  leave_blurred(base + p.y * size.x + p.x, mean);
}
