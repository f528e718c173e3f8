// Where a view's parts stand in a texel buffer of views, in texels of four words. Included by C++ inside namespace
// render::gpu and by GLSL.
const int kSurfaceTexels = 8;
const int kLensTexels = 5 + 2 * kSurfaceTexels;
const int kViewTexels = kLensTexels + 12;
const int kViewWorldAt = kLensTexels + 7;  // columns of world_from_eye
