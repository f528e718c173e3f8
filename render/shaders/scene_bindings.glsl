// The scene's and the lenses' buffers, at the same places in every kernel that traces. See render/tracer_buffers.hpp.
layout(binding = 0) uniform samplerBuffer lens_table;
layout(binding = 1) uniform usamplerBuffer bvh_nodes;
layout(binding = 2) uniform samplerBuffer bvh_triangles;
layout(binding = 3) uniform samplerBuffer shading_triangles;
layout(binding = 4) uniform usamplerBuffer texels;  // RGB9E5, linear

layout(constant_id = 0) const uint kSurfaceKinds = 0xffffffffu;  // bit k: some lens has a back of kind k; bit 16 + k: a front
layout(constant_id = 1) const uint kShadows = 1u;               // 0: lights reach everywhere
#define BACK_KINDS (kSurfaceKinds & 0xffffu)
#define FRONT_KINDS (kSurfaceKinds >> 16)

#include "lenses/gpu/optics.h"
#include "render/shaders/frame.h"
#include "render/shaders/view.h"

// Uniform buffers: what all lanes read alike costs a software device one load instead of one a lane. Structures of
// vec4 and ivec4 lie the same in std140 and std430.
layout(std140, binding = 5) uniform Views { ViewData views[kMostViews]; };
layout(std140, binding = 6) uniform Environment { EnvironmentData environment; };
// Lists of structures, four words a texel: a software device loads a storage buffer word by word, lane by lane.
layout(binding = 7) uniform usamplerBuffer lights;
layout(binding = 8) uniform usamplerBuffer materials;
layout(binding = 9) uniform usamplerBuffer textures;
layout(push_constant) uniform Frame { FrameData frame; };

LightData light_data(int i) {
  return LightData(uintBitsToFloat(texelFetch(lights, 4 * i)), uintBitsToFloat(texelFetch(lights, 4 * i + 1)),
                   uintBitsToFloat(texelFetch(lights, 4 * i + 2)), uintBitsToFloat(texelFetch(lights, 4 * i + 3)));
}

MaterialData material_data(uint i) {
  int at = 3 * int(i);
  return MaterialData(uintBitsToFloat(texelFetch(materials, at)), uintBitsToFloat(texelFetch(materials, at + 1)),
                      ivec4(texelFetch(materials, at + 2)));
}

TextureData texture_data(int i) { return TextureData(ivec4(texelFetch(textures, i))); }

#include "render/shaders/traverse_bvh4.glsl"
