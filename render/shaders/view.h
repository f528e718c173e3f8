// What the host hands to the kernels that trace: views, lights, materials. Included after lenses/gpu/optics.h, in C++
// inside namespace render::gpu. Only vec4 and ivec4 members, so that std430 and C++ agree without padding.

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

const int kLightDirectional = 0;
const int kLightPoint = 1;
const int kLightSpot = 2;

struct LightData {
  vec4 colour;     // linear r, g, b; w: type
  vec4 position;   // m, world; w: range, 0 for unlimited
  vec4 direction;  // unit, world, the way the light travels
  vec4 cone;       // cosines of the inner and outer angle
};

struct MaterialData {
  vec4 base_colour;  // linear
  vec4 emission;     // linear radiance; w: 1 if double sided
  ivec4 textures;    // base colour, emission: index or -1
};

struct TextureData {
  ivec4 size;  // first texel, width, height, wrap_u | wrap_v << 8
};

struct EnvironmentData {
  vec4 sky_zenith;
  vec4 sky_horizon;
  vec4 ambient;
  ivec4 counts;  // lights
};
