// Linear light as the display's bytes, r in the lowest.

float srgb(float x) { return x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1.0 / 2.4) - 0.055; }

uint display_bytes(vec3 shown) {
  uvec3 c = uvec3(round(shown * 255.0));
  return c.r | (c.g << 8) | (c.b << 16) | 0xff000000u;
}

uint display_bytes(vec3 radiance, float exposure) {
  vec3 linear = clamp(radiance * exposure, vec3(0.0), vec3(1.0));
  return display_bytes(vec3(srgb(linear.r), srgb(linear.g), srgb(linear.b)));
}

// Radiance as half floats.
uint display_bytes(uvec2 radiance, float exposure) {
  return display_bytes(vec3(unpackHalf2x16(radiance.x), unpackHalf2x16(radiance.y).x), exposure);
}

const uint kHalfOne = 0x3c00u;

// What packHalf2x16 and back would make of it, for a fraction of the instructions of a device without such conversions:
// what is shown at once and what is kept first are one picture. Not negative; to the nearest, ties to even.
vec3 rounded_to_half(vec3 radiance) {
  uvec3 bits = floatBitsToUint(radiance);
  return uintBitsToFloat((bits + 0xfffu + ((bits >> 13) & 1u)) & 0xffffe000u);
}
