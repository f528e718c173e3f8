// What the shrink kernel is told of a block of pixels, declared once: C++ includes this inside namespace render::gpu
// (render/frame_types.hpp), GLSL as it is.
struct ShrinkBlock {
  ivec4 source;  // word of its first pixel, words from row to row; 1 where red and blue change places
  ivec4 place;   // x, y, width, height in the whole picture
  ivec4 sizes;   // width, height of the whole picture, then of its copy
  ivec4 target;  // x, y, width, height in the copy
};
