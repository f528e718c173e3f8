// Where a pixel of the picture goes: linear radiance as half floats, two words, or the display's bytes.
#include "render/shaders/display.glsl"

layout(std430, binding = 1) writeonly buffer Blurred { uint blurred[]; };

void leave_halves(int at, uvec2 halves) {
  blurred[2 * at] = halves.x;
  blurred[2 * at + 1] = halves.y;
}

// packed: a pixel's first two words.
void leave_sharp(int at, uvec2 packed) {
  if (kEncode != 0u) {
    blurred[at] = display_bytes(packed, frame.limits.z);
  } else {
    leave_halves(at, uvec2(packed.x, (packed.y & 0xffffu) | (kHalfOne << 16)));
  }
}

void leave_blurred(int at, vec3 radiance) {
  if (kEncode != 0u) {
    blurred[at] = display_bytes(rounded_to_half(radiance), frame.limits.z);
  } else {
    leave_halves(at, uvec2(packHalf2x16(radiance.rg), packHalf2x16(vec2(radiance.b, 1.0))));
  }
}
