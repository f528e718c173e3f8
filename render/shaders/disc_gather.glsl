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

// The coarsest squares that still give the most taps, none wider than the minor semi-axis.
int level_of(float area, float minor, int least) {
  float squares = 0.5 * log2(area / float(4 * kMostRings * kMostRings));
  return clamp(int(ceil(min(squares, log2(max(minor, 1.0))))), least, 3);
}

// Around `at` (px), over squares of the level; variance: px^2, what else widens the picture of a point.
// a: how many taps it is the sum of.
vec4 disc_sum(vec3 ellipse, float area, vec2 at, int level, float variance, int base) {
  float side = float(1 << level);
  int rings = rings_of(area / (side * side), kMostRings);
  // A square's own width and the rounding of a tap to one.
  vec3 s = shrunk(ellipse, variance + (2.0 * side * side - 1.0) / 12.0) / side;
  ivec2 centre = ivec2(floor(at / side));
  vec2 beside = at / side - vec2(centre) - 0.5;
  ivec2 last = (frame.size.xy - 1) >> level;
  vec4 sum = vec4(0.0);
  for (int ring = 0; ring < rings; ++ring) {
    vec2 disc = ring_radius(ring, rings) * ring_start(ring);
    float angle = 2.0 * kPi / float(ring_points(ring));
    vec2 turn = vec2(cos(angle), sin(angle));
    for (int k = 0; k < ring_points(ring); ++k) {
      vec2 offset = vec2(s.x * disc.x + s.y * disc.y, s.y * disc.x + s.z * disc.y);
      vec4 tap = level_tap(clamp(centre + ivec2(round(beside + offset)), ivec2(0), last), level, base);
      sum += tap.w * vec4(tap.rgb, 1.0);
      disc = vec2(disc.x * turn.x - disc.y * turn.y, disc.x * turn.y + disc.y * turn.x);
    }
  }
  return sum;
}

float ellipse_area(float major, float minor) { return kPi * major * max(minor, 1.0); }
