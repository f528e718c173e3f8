// The scene's and the lenses' buffers, at the same places in every kernel that traces. See render/kernel_set.cpp.
layout(binding = 0) uniform samplerBuffer lens_table;
layout(binding = 1) uniform usamplerBuffer bvh_nodes;
layout(binding = 2) uniform samplerBuffer bvh_triangles;
layout(binding = 3) uniform samplerBuffer shading_triangles;
layout(binding = 4) uniform usamplerBuffer texels;  // render/scene/texture_texels.hpp

layout(constant_id = 0) const uint kSurfaceKinds = 0xffffffffu;  // surface_kinds() of render/gpu_tracer.hpp
#define BACK_KINDS (kSurfaceKinds & 0xffffu)
#define FRONT_KINDS ((kSurfaceKinds >> 16) & 0x7fffu)
#define MAY_CROSS ((kSurfaceKinds >> 31) != 0u)
layout(constant_id = 5) const uint kLensIterations = 0u;
#define NEWTON_STEPS int(kLensIterations)
layout(constant_id = 6) const uint kKeepTransfer = 0u;  // 1: rays leave their ray-transfer matrices, found rays take them
layout(constant_id = 9) const uint kViewTraits = 0xffffffffu;  // view_traits() of render/view_setup.hpp
#define VIEWINGS (kViewTraits & 7u)
#define MAY_SIT_ON_EYE ((kViewTraits & 8u) != 0u)
#define MAY_BE_VIRTUAL ((kViewTraits & 16u) != 0u)
layout(constant_id = 4) const uint kBare = 0u;  // 1: the first light only, without shadow rays
layout(constant_id = 1) const uint kSceneFeatures = 0xffffffffu;  // what the scene has need of, kFeature... of view.h
#define HAS(features) ((kSceneFeatures & uint(features)) != 0u)

#include "lenses/gpu/optics.h"
#include "render/shaders/frame.h"
#include "render/shaders/view.h"

#include "render/shaders/view_words.glsl"

// A uniform buffer, read at constant places: one load for all lanes of a software device. Structures of vec4 and ivec4
// lie the same in std140 and std430.
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

// A material is read part by part, because most kernels look at few of them. `part`: kMaterial...At of view.h.
vec4 material_part(uint material, int part) {
  return uintBitsToFloat(texelFetch(materials, kMaterialTexels * int(material) + part));
}

ivec4 material_indices(uint material, int part) {
  return ivec4(texelFetch(materials, kMaterialTexels * int(material) + part));
}

ivec4 texture_size(int i) { return ivec4(texelFetch(textures, 2 * i)); }
int texture_levels(int i) { return int(texelFetch(textures, 2 * i + 1).x); }

#include "render/scene/gpu/bvh_layout.h"
#include "render/shaders/texture.glsl"
#include "render/shaders/alpha.glsl"
#include "render/shaders/traverse_bvh4.glsl"
