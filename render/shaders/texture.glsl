// Textures in one texel buffer (render/scene/texture_texels.hpp), filtered over a pixel's footprint: linear between
// texels and between mip levels, with up to kMostProbes of them along the footprint's longer axis.

const int kMostProbes = 4;

vec3 rgb9e5(uint packed) {
  float scale = uintBitsToFloat(((packed >> 27) + 103u) << 23);  // 2^(exponent - 24)
  return vec3(float(packed & 511u), float((packed >> 9) & 511u), float((packed >> 18) & 511u)) * scale;
}

// i: a whole number below 1e7, so that floats are exact but for the quotient, whose rounding the clamp catches. Integer
// division has no vector form on CPUs.
int wrapped(float i, float n, int mode) {
  float period = mode == 2 ? 2.0 * n : n;
  float j = i - period * floor(i / period);
  j = mode == 2 && j >= n ? period - 1.0 - j : j;
  return int(clamp(mode == 1 ? i : j, 0.0, n - 1.0));
}

vec3 texel_at(int first, int i, int format) {
  uint packed = texelFetch(texels, first + (format == kTexelAlpha ? i >> 2 : i)).x;
  if (format == kTexelColour) {
    return rgb9e5(packed);
  }
  return format == kTexelData ? unpackUnorm4x8(packed).rgb : vec3(float((packed >> (8 * (i & 3))) & 255u) / 255.0);
}

vec3 sample_level(ivec4 t, int level, vec2 uv, int format) {
  int width = max(t.y >> level, 1);
  int height = max(t.z >> level, 1);
  int first = level == 0 ? t.x + kTextureHeader : t.x + int(texelFetch(texels, t.x + level).x);
  vec2 size = vec2(float(width), float(height));
  vec2 p = uv * size - 0.5;
  vec2 corner = floor(p);
  vec2 w = p - corner;
  vec2 low = clamp(corner, vec2(-1e7), vec2(1e7));
  int x0 = wrapped(low.x, size.x, t.w & 255);
  int x1 = wrapped(low.x + 1.0, size.x, t.w & 255);
  int y0 = wrapped(low.y, size.y, (t.w >> 8) & 255) * width;
  int y1 = wrapped(low.y + 1.0, size.y, (t.w >> 8) & 255) * width;
  vec3 top = mix(texel_at(first, y0 + x0, format), texel_at(first, y0 + x1, format), w.x);
  vec3 bottom = mix(texel_at(first, y1 + x0, format), texel_at(first, y1 + x1, format), w.x);
  return mix(top, bottom, w.y);
}

// How far texture coordinates move from one pixel to the next, across and up.
struct UvFootprint {
  vec2 across;
  vec2 up;
};

// The footprint's ellipse in texels, as its axes: principal axes of G G^T, G = (across, up).
vec3 sample_texture(int index, vec2 uv, UvFootprint footprint, int format) {
  ivec4 t = texture_size(index);
  vec2 size = vec2(float(t.y), float(t.z));
  vec2 a = footprint.across * size;
  vec2 b = footprint.up * size;
  vec3 m = vec3(a.x * a.x + b.x * b.x, a.x * a.y + b.x * b.y, a.y * a.y + b.y * b.y);
  float difference = 0.5 * (m.x - m.z);
  float largest = 0.5 * (m.x + m.z) + sqrt(difference * difference + m.y * m.y);
  float major = sqrt(max(largest, 0.0));
  float minor = abs(a.x * b.y - a.y * b.x) / max(major, 1e-9);
  // Below one texel nothing is averaged; the upper bound keeps broken numbers out of loops and addresses.
  major = clamp(major, 1.0, 1e6);
  minor = clamp(minor, 1.0, major);
  int probes = clamp(int(major / minor + 0.5), 1, kMostProbes);
  float level = log2(max(minor, major / float(probes)));
  int levels = texture_levels(index);
  int low = clamp(int(floor(level)), 0, levels - 1);
  int high = min(low + 1, levels - 1);
  float between = clamp(level - float(low), 0.0, 1.0);
  vec2 axis = m.x > m.z ? vec2(largest - m.z, m.y) : vec2(m.y, largest - m.x);
  float length2 = dot(axis, axis);
  vec2 along = length2 > 0.0 ? axis * (major * inversesqrt(length2)) / size : vec2(0.0);
  vec3 sum = vec3(0.0);
  for (int i = 0; i < probes; ++i) {
    vec2 at = uv + ((float(i) + 0.5) / float(probes) - 0.5) * along;
    vec3 fine = sample_level(t, low, at, format);
    if (between > 0.0) {
      fine = mix(fine, sample_level(t, high, at, format), between);
    }
    sum += fine;
  }
  return sum / float(probes);
}
