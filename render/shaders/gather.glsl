// Approximate defocus (paper, section 6.3): each pixel gathers over its own blur ellipse. The ellipse comes from the
// eigenvalues of the residual, and the kernel is the uniform ellipse of a round pupil rather than the paper's Gaussian,
// which kGaussian asks for. Here: what its kernels share.
#include "render/shaders/frame.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant) uniform Frame { FrameData frame; };
#include "render/shaders/group.glsl"
layout(constant_id = 0) const int kTaps = 0;  // about the most of a gathered blur; 0: nothing is blurred
layout(constant_id = 1) const uint kGaussian = 0u;
layout(constant_id = 2) const uint kEncode = 0u;  // 1: to the display's bytes, 0: to linear radiance
layout(constant_id = 3) const int kRate = 1;  // px between gathered ones where the minor semi-axis is kWideBlur or more
layout(constant_id = 4) const uint kWide = 0u;  // 1: binding 0 is a picture that wide blurs gather from (frame.h)
layout(binding = 0) uniform usamplerBuffer pixels;

const float kPi = 3.14159265358979;
// How far a kernel reaches, in radii of the disc: a Gaussian of the disc's second moments has lost 0.0004 % there.
float kernel_reach() { return kGaussian != 0u ? 2.5 : 1.0; }

// What reaches into a tile: how far (px) what lies in front does, -1 where no blur reaches across depth; how near (1/m)
// the nearest is. The includer that needs it declares `reaches`.
#define TILE_REACH(tile) \
  uintBitsToFloat(texelFetch(reaches, (tile).y * tile_count().x + (tile).x).xy)

struct Tap {
  vec3 radiance;
  vec3 ellipse;
  float depth;
};

Tap unpack_tap(uvec4 p) {
  vec2 rg = unpackHalf2x16(p.x);
  vec2 bx = unpackHalf2x16(p.y);
  Tap tap;
  tap.radiance = vec3(rg, bx.x);
  tap.ellipse = vec3(bx.y, unpackHalf2x16(p.z));
  tap.depth = uintBitsToFloat(p.w);
  return tap;
}

// Of a square of 2 pixels what lies nearest: its share of the square, and its means.
struct Square {
  vec3 radiance;
  float coverage;
  vec3 ellipse;
  float nearness;
};

uvec4 pack_square(Square square) {
  return uvec4(packHalf2x16(square.radiance.rg), packHalf2x16(vec2(square.radiance.b, square.ellipse.x)),
               packHalf2x16(square.ellipse.yz), packHalf2x16(vec2(square.nearness, square.coverage)));
}

Square unpack_square(uvec4 p) {
  vec2 bx = unpackHalf2x16(p.y);
  vec2 nc = unpackHalf2x16(p.w);
  return Square(vec3(unpackHalf2x16(p.x), bx.x), nc.y, vec3(bx.y, unpackHalf2x16(p.z)), nc.x);
}

Tap tap_at(int at) { return unpack_tap(texelFetch(pixels, at)); }

// 1/depth orders points from near to far with the sky last.
float nearness(float depth) { return depth > 0.0 ? 1.0 / depth : 0.0; }

float major(vec3 s) { return 0.5 * (s.x + s.z) + sqrt(0.25 * (s.x - s.z) * (s.x - s.z) + s.y * s.y); }

ivec2 tile_count() { return (frame.size.xy + kBlurTile - 1) / kBlurTile; }

// A tile in a list: two halves of a word (listed_tiles.glsl).
uint pack_tile(ivec2 tile) { return uint(tile.x | tile.y << 16); }

// Where the view's pixels start in binding 0, and from row to row.
int first_pixel() { return kWide != 0u ? 0 : frame.view.x * frame.size.x * frame.size.y; }
int pixels_a_row() { return kWide != 0u ? blur_level_width(tile_count(), 0) : frame.size.x; }

// The least major semi-axis that has a use for means over squares (level_of, kWideBlur). A Gaussian's weights are made
// in the kernels of wide blurs alone.
float least_wide() {
  float least = sqrt(2.0 * float(max(kTaps, 1)) / kPi);
  least = kRate > 1 ? min(least, kWideBlur) : least;
  return max(kGaussian != 0u ? 0.0 : least, frame.limits.x);
}

// How many tiles around its own a tile that gathers within `reach` px takes taps from: besides the reach half a cell on
// the taps' grid (squares of half the widest cell and more), and the pixel's own place in squares of 2.
int tiles_gathered(float reach) {
  float cell = 1.5 * reach * sqrt(kPi / float(max(kTaps, 1)));
  return int(ceil((reach + max(4.0, cell)) / float(kBlurTile)));
}

// Whether blurs go so far (px) that all tiles count as gathered from.
bool all_are_sources(float most) { return tiles_gathered(most) > kMostBlurTiles; }

// An ellipse whose second moments are less by `variance` (px^2) along every direction: what the taps' own size adds.
vec3 shrunk(vec3 s, float variance) {
  float a = major(s);
  float b = max(s.x + s.z - a, 0.0);
  // A uniform disc's second moments are a quarter of its squared radius.
  float a_less = sqrt(max(a * a - 4.0 * variance, 0.0));
  float b_less = sqrt(max(b * b - 4.0 * variance, 0.0));
  float slope = a - b > 1e-3 * a ? (a_less - b_less) / (a - b) : 0.0;
  float level = a_less - slope * a;
  return slope * s + vec3(level, 0.0, level);
}

// What taps widen the picture of a point by (px^2): the width of the squares they are means of, and, measured over places
// of the point, half of what the width of their cells would come to.
float taps_variance(float side, float cell) { return (side * side - 1.0) / 12.0 + (cell * cell - 1.0) / 24.0; }

// An ellipse over a grid of cells, row by row: each row's cells count by how much of them the ellipse covers, or by a
// Gaussian of its second moments. In cells; `centre` from the middle of cell (0, 0).
struct Rows {
  vec2 centre;
  float top;    // the ellipse's extent upwards
  float lean;   // how far a row's middle moves with each row
  float width;  // half of the middle row
  float softness;  // a row's ends are as wide as a cell and what the row leans within its height
  float inverse_top, inverse_softness;
};

Rows rows_of(vec3 s, vec2 centre) {
  float top = max(sqrt(s.y * s.y + s.z * s.z), 0.02);
  float det = max(s.x * s.z - s.y * s.y, 0.0);
  float inverse_top = 1.0 / top;
  float lean = s.y * (s.x + s.z) * inverse_top * inverse_top;
  float softness = sqrt(1.0 + lean * lean);
  return Rows(centre, top, lean, max(det * inverse_top, 0.02), softness, inverse_top, 1.0 / softness);
}

// First and last row, or cell of a row.
ivec2 cells_between(float low, float high) { return ivec2(floor(low + 0.5), ceil(high - 0.5)); }

ivec2 row_range(Rows rows) {
  float top = kernel_reach() * rows.top;
  return cells_between(rows.centre.y - top, rows.centre.y + top);
}

// The integral of the unit circle's half width, (y sqrt(1 - y^2) + asin y) / 2, to 2e-5: what is left of a quarter of
// the disc goes as the distance from its rim to 3/2.
float half_widths(float y) {
  float t = max(1.0 - abs(y), 0.0);
  float left = t * sqrt(t) * (0.942819 + t * (-0.1417378 + t * (-0.01112917 - t * 0.004538979)));
  float within = 0.25 * kPi - left;
  return y < 0.0 ? -within : within;
}

// The middle of a row's part of the ellipse. Only so far up as the ellipse goes: a thin one would lean out of its own
// extent.
float row_middle(float y, float top, float lean) {
  float from = y - 0.5 > -top ? y - 0.5 : -top;
  float to = y + 0.5 < top ? y + 0.5 : top;
  return 0.5 * lean * (from + to);
}

// From where to where a row's part of the ellipse goes, as its mean over the row's height.
vec2 row_span(Rows rows, int row) {
  float y = float(row) - rows.centre.y;
  float middle = rows.centre.x + row_middle(y, kernel_reach() * rows.top, rows.lean);
  float part = kernel_reach();
  if (kGaussian == 0u) {
    part = rows.top * (half_widths((y + 0.5) * rows.inverse_top) - half_widths((y - 0.5) * rows.inverse_top));
  }
  return middle + rows.width * vec2(-part, part);
}

ivec2 row_cells(Rows rows, vec2 span) {
  float beyond = 0.5 * rows.softness - 0.5;
  return cells_between(span.x - beyond, span.y + beyond);
}

float cell_weight(Rows rows, vec2 span, int row, int cell) {
  if (kGaussian != 0u) {
    vec2 inner = vec2((float(cell) - 0.5 * (span.x + span.y)) / rows.width, (float(row) - rows.centre.y) / rows.top);
    return exp(-2.0 * dot(inner, inner));
  }
  vec2 past = clamp((float(cell) - span) * rows.inverse_softness + 0.5, 0.0, 1.0);
  return past.x - past.y;
}

// The nine weights of a blur within the pixel, with the ellipse's own second moments, S S^T / 4.
float small_weight(vec3 s, ivec2 o) {
  vec3 m = 0.25 * vec3(s.x * s.x + s.y * s.y, s.y * (s.x + s.z), s.y * s.y + s.z * s.z);
  float diagonal = 0.5 * abs(m.y);
  vec2 straight = max(0.5 * m.xz - diagonal, vec2(0.0));
  bool leans = o.x * o.y != 0 && float(o.x * o.y) * m.y > 0.0;
  return leans ? diagonal : (o.y == 0 && o.x != 0 ? straight.x : (o.x == 0 && o.y != 0 ? straight.y : 0.0));
}
