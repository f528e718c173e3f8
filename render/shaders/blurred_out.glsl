// Where a blurred pixel goes: linear radiance as half floats, two words, or the display's bytes.
#include "render/shaders/display.glsl"

layout(std430, binding = 1) writeonly buffer Blurred { uint blurred[]; };

void leave_blurred(int at, vec3 radiance) {
  uvec2 halves = uvec2(packHalf2x16(radiance.rg), packHalf2x16(vec2(radiance.b, 1.0)));
  if (kEncode != 0u) {
    blurred[at] = display_bytes(halves, frame.limits.z);
  } else {
    blurred[2 * at] = halves.x;
    blurred[2 * at + 1] = halves.y;
  }
}
