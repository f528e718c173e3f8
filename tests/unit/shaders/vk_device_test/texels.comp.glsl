// Element 1 of each kind of texel buffer as bits, the uniform buffer, and the number of texels.
#version 460
layout(local_size_x = 1) in;
layout(set = 0, binding = 0) uniform samplerBuffer rgba32f;
layout(set = 0, binding = 1) uniform usamplerBuffer rgba32ui;
layout(set = 0, binding = 2) uniform usamplerBuffer r32ui;
layout(set = 0, binding = 3) uniform samplerBuffer rgba8_unorm;
layout(set = 0, binding = 4) uniform Values { uvec4 values; } uniforms;
layout(set = 0, binding = 5, std430) writeonly buffer Out { uvec4 values[]; } target;

void main() {
  target.values[0] = floatBitsToUint(texelFetch(rgba32f, 1));
  target.values[1] = texelFetch(rgba32ui, 1);
  target.values[2] = texelFetch(r32ui, 1);
  target.values[3] = floatBitsToUint(texelFetch(rgba8_unorm, 1));
  target.values[4] = uniforms.values;
  target.values[5] = uvec4(textureSize(rgba32f), textureSize(rgba32ui), textureSize(r32ui), textureSize(rgba8_unorm));
}
