// What the composite kernel is told of a view, declared once: C++ includes this inside namespace render::gpu
// (render/frame_types.hpp), GLSL as it is.
struct CompositeData {
  ivec4 shown;    // width, height of the picture; 1 where linear radiance is wanted too; pixels in a blur's reach
  ivec4 whole;    // width, height of the layer that covers the picture
  ivec4 fovea;    // width, height of the layer around the gaze, 0 for none; its upper left corner in the picture
  ivec4 extent;   // width, height in the picture of the layer around the gaze
  vec4 tangents;  // of the picture's half angles: left, right, down, up
  vec4 gaze;      // unit, picture axes; w: exposure factor
  vec4 limits;    // cosines of angles from the gaze: the fovea's layer alone within the first, none of it beyond the second
};
