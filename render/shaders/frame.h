// A frame's settings, declared once: C++ includes this inside namespace render::gpu (render/frame_types.hpp), GLSL
// as it is. Only vec4, ivec4 and uvec4 members, so that std430 and C++ agree without padding.

const int kModePinhole = 0;
const int kModeAdof = 1;
const int kModeDof = 2;
const int kModePower = 3;
const int kModeAstigmatism = 4;
const int kModeAccommodation = 5;
const int kModeBlur = 6;

// 96 bytes of push constants, the same for every kernel of a frame.
struct FrameData {
  ivec4 size;      // width, height, views, mode
  ivec4 sampling;  // index of this sample (dof), -, seed, colour map
  vec4 limits;     // smallest blur drawn (px), largest blur (px), exposure factor, -
  vec4 map_range;  // low, high, unit factor, -
  // x: the view of this dispatch. Here and not a workgroup's index: what a push constant selects in a uniform buffer is
  // one load for all invocations of a software device, what anything else selects is one for each.
  // y: the round of edge rays, 0 or 1. z: between how many threads the device divides a dispatch (group.glsl). w: 0.
  ivec4 view;
  uvec4 sample_point;  // dof: the point that all pixels make their own (sample_pattern.h)
};

// A traced pixel, 16 bytes: radiance and the blur ellipse as half floats, the depth beside them.
//   x: radiance r, g   y: radiance b, ellipse xx   z: ellipse xy, yy   w: bits(depth)
// The ellipse is the symmetric root of the blur's shape: it takes the unit disc to the blur in pixels.
// depth: metres along the refracted ray, 0 = sky, -1 = none.

// A pixel's wavefront, two vec4: (V.hh, V.hv, V.vv, accommodation), (blur major semi-axis in rad, depth, status, -).
const int kWavefrontTexels = 2;

// Squares of pixels that share a beam (beam.glsl), row by row.
const int kBeamBlock = 4;

// A list of pixels: how many workgroups x, y, z go through it (vkCmdDispatchIndirect), how many items there are, the
// items. list.glsl appends.
const uint kListGroup = 64u;       // items of a workgroup
const uint kListMostGroups = 65535u;
const uint kListCountAt = 3u;
const uint kListFirstAt = 4u;
const uint kListThin = 0x80000000u;  // on an edge pixel: found by its beam alone, so that few rays may miss it
