// A frame's settings, declared once: C++ includes this inside namespace render::gpu (render/frame_types.hpp), GLSL
// as it is. Only vec4, ivec4 and uvec4 members, so that std430 and C++ agree without padding.

const int kModePinhole = 0;
const int kModeAdof = 1;
const int kModeDof = 2;
const int kModePower = 3;
const int kModeAstigmatism = 4;
const int kModeAccommodation = 5;
const int kModeBlur = 6;

// 112 bytes of push constants, the same for every kernel of a frame.
struct FrameData {
  ivec4 size;      // width, height, views, mode
  ivec4 sampling;  // index of this sample (dof), words from one view's list of tiles to the next, seed, colour map
  vec4 limits;     // smallest blur drawn (px), largest blur (px), exposure factor,
                   // how many pixels the pupil's half sets apart what lies a dioptre apart
  vec4 map_range;  // low, high, unit factor, -
  // x: the view of this dispatch. Here and not a workgroup's index: what a push constant selects in a uniform buffer is
  // one load for all invocations of a software device, what anything else selects is one for each.
  // y: the round of edge rays, 0 or 1. z: between how many threads the device divides a dispatch (group.glsl). w: 0,
  // as an index.
  ivec4 view;
  uvec4 sample_point;  // dof: the point that all pixels make their own (sample_pattern.h)
  vec4 corners;  // of interpolated lens rays: pixels between them along x and y, how many along x and y
};

// A traced pixel, 16 bytes: radiance and the blur ellipse as half floats, the depth beside them.
//   x: radiance r, g   y: radiance b, ellipse xx   z: ellipse xy, yy   w: bits(depth)
// The ellipse is the symmetric root of the blur's shape: it takes the unit disc to the blur in pixels.
// depth: metres along the refracted ray, 0 = sky, -1 = none.

// A pixel's wavefront, two vec4: (V.hh, V.hv, V.vv, accommodation), (blur major semi-axis in rad, depth, status, -).
const int kWavefrontTexels = 2;

// A kept ray-transfer matrix (LensAccuracy), four vec4: A, B, C, D by columns, the outgoing basis by upright_axis.
const int kTransferTexels = 4;
// A corner of interpolated lens rays, six vec4: (origin, code), (direction, of length 1
// along the picture's axis, code) in primary axes, the transfer.
// code: the status and, in bits above it, which segments the ray has met.
const int kCornerTexels = 6;
const int kCornerStatusBits = 8;  // codes are less than this where no segment is met

// Squares of pixels that share a beam (beam.glsl), row by row.
const int kBeamBlock = 4;

// A list of pixels: how many workgroups x, y, z go through it (vkCmdDispatchIndirect), how many items there are, the
// items. list.glsl appends.
const uint kListGroup = 64u;       // items of a workgroup
const uint kListMostGroups = 65535u;
const uint kListCountAt = 3u;
const uint kListFirstAt = 4u;
const uint kListThin = 0x80000000u;  // on an edge pixel: found by its beam alone, so that few rays may miss it

// Approximate defocus looks at a picture tile by tile.
const int kBlurTile = 8;         // px a side
const uint kListAcross = 32768u; // workgroups of a row that goes through a list of tiles, if there are more than a row
const uint kSquaredTiles = 4u;   // that a workgroup gathers squares of 2 pixels in
const uint kNarrowTiles = 4u;   // that a workgroup blurs by squares of 2 pixels
const int kMostBlurTiles = 16;   // as far as a tile looks for blur that reaches it
const float kBlurParallax = 0.5; // px that the pupil's half may set apart what counts as one depth
const float kNearestFill = 1.0; // px^-2: how soon light behind an edge counts less with distance
const uint kWideGroupsAt = 0u;   // whether a picture has wide blurs: how many groups of tiles across, or 0,
const uint kWidestAt = 3u;       // and the bits of its largest
const float kWideBlur = 6.0;     // px, a minor semi-axis from which neighbours may share a gather

// A picture that wide blurs gather from, of texels like traced pixels, row by row: the pixels themselves in whole tiles;
// means over squares of 2, 4 and 8 pixels; and of squares of 2 pixels the mean of what lies nearest.
const int kWideTexels = 101;  // a tile
#ifndef __cplusplus
int blur_level_width(ivec2 tiles, int level) { return tiles.x * (kBlurTile >> level); }
int blur_level_start(ivec2 tiles, int level) {
  return tiles.x * tiles.y * (level > 1 ? (level > 2 ? 84 : 80) : (level > 0 ? 64 : 0));
}
int blur_nearest_start(ivec2 tiles) { return 85 * tiles.x * tiles.y; }
#endif
