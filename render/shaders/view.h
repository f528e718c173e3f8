// What the host hands to the kernels that trace: views, lights, materials. Included after lenses/gpu/optics.h, in C++
// inside namespace render::gpu. Only vec4 and ivec4 members, so that std430 and C++ agree without padding.

#include "render/shaders/features.h"

const int kMostViews = 4;  // two eyes, two pairs

// One view: an eye, its lens, its picture and where it stands in the world.
struct ViewData {
  LensData lens;
  EyeData eye;         // pupil.z: accommodation if the state is one for the whole picture, negative if per ray
  vec4 picture_x;      // columns of the rotation eye_from_picture (primary axes); w: none
  vec4 picture_y;
  vec4 picture_z;
  vec4 tangents;       // of the half angles: left, right, down, up
  vec4 gaze;           // unit, primary axes; w: viewing, as kViewingFixed...
  vec4 world_x;        // columns of world_from_eye; w: the translation's components
  vec4 world_y;
  vec4 world_z;
  vec4 tint;           // transmission of the spectacles r, g, b; w: unused
  vec4 virtual_image;  // x: distance of the headset's virtual image (m), 0 for none; y: its view origin behind the pupil
};

#include "render/shaders/view_texels.h"

const int kLightDirectional = 0;
const int kLightPoint = 1;
const int kLightSpot = 2;

struct LightData {
  vec4 colour;     // linear r, g, b; w: type
  vec4 position;   // m, world; w: range, 0 for unlimited
  vec4 direction;  // unit, world, the way the light travels
  vec4 cone;       // cosines of the inner and outer angle
};

// A material's textures, in the order of its transforms.
const int kSlotBaseColour = 0;
const int kSlotEmission = 1;
const int kSlotSurface = 2;  // roughness in green, metallic in blue
const int kSlotNormal = 3;
const int kSlotOcclusion = 4;
const int kTextureSlots = 5;

const int kMaterialMatte = 1;  // neither metallic nor smooth anywhere
const int kMaterialBlends = 2;
const int kMaterialUnlit = 4;

// Textures are indices or -1.
struct MaterialData {
  vec4 base_colour;  // linear
  vec4 emission;     // linear radiance
  ivec4 textures;    // base colour, emission, surface, normal
  ivec4 flags;       // kMaterial..., bit k: slot k takes the second coordinates, alpha texture, occlusion texture
  vec4 surface;      // metallic, roughness, -, alpha cutoff
  vec4 maps;         // normal scale, occlusion strength
  vec4 uv_linear[kTextureSlots];  // columns of KHR_texture_transform's matrix
  vec4 uv_offset[kTextureSlots];
};

// Where its parts stand, in texels of four words.
const int kMaterialBaseColourAt = 0;
const int kMaterialEmissionAt = 1;
const int kMaterialTexturesAt = 2;
const int kMaterialFlagsAt = 3;
const int kMaterialSurfaceAt = 4;
const int kMaterialMapsAt = 5;
const int kMaterialUvLinearAt = 6;
const int kMaterialUvOffsetAt = kMaterialUvLinearAt + kTextureSlots;
const int kMaterialTexels = kMaterialUvOffsetAt + kTextureSlots;

// How a texture's texels are stored.
const int kTexelColour = 0;  // RGB9E5, linear
const int kTexelData = 1;    // 4 x 8 bit
const int kTexelAlpha = 2;   // four texels a word
const int kTextureHeader = 16;  // words before the finest level: where each level begins, from the first of them

struct TextureData {
  ivec4 size;  // first word, width, height, wrap_u | wrap_v << 8 | kTexel... << 16
  ivec4 more;  // levels
};

struct EnvironmentData {
  vec4 sky_zenith;
  vec4 sky_horizon;
  vec4 ambient;
  ivec4 counts;  // -, first texel of the second coordinates and colours
  // The first light, and nothing; it gives none in a scene without lights. Two, so that it is looked up by an index:
  // lavapipe compiles a kernel anew for each dispatch that branches on a uniform buffer's words at a constant place.
  LightData first_light[2];
};
