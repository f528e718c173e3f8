// Linear light as the display's bytes, r in the lowest.

float srgb(float x) { return x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1.0 / 2.4) - 0.055; }

uint display_bytes(vec3 shown) {
  uvec3 c = uvec3(round(shown * 255.0));
  return c.r | (c.g << 8) | (c.b << 16) | 0xff000000u;
}

// Radiance as half floats.
uint display_bytes(uvec2 radiance, float exposure) {
  vec3 linear = vec3(unpackHalf2x16(radiance.x), unpackHalf2x16(radiance.y).x) * exposure;
  linear = clamp(linear, vec3(0.0), vec3(1.0));
  return display_bytes(vec3(srgb(linear.r), srgb(linear.g), srgb(linear.b)));
}
