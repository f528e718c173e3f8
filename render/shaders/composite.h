// What the composite kernel is told: C++ includes this inside namespace render::gpu (render/composite.cpp), GLSL as it
// is. 112 bytes of push constants.
struct CompositeData {
  ivec4 shown;    // width, height of the picture; the view; 1 where linear radiance is wanted too
  ivec4 whole;    // width, height of the layer that covers the picture
  ivec4 fovea;    // width, height of the layer around the gaze, 0 for none; where its upper left corner lies in the picture
  ivec4 extent;   // width, height in the picture of the layer around the gaze
  vec4 tangents;  // of the picture's half angles: left, right, down, up
  vec4 gaze;      // unit, picture axes; w: exposure factor
  vec4 limits;    // cosines of the angles from the gaze: the fovea's layer alone within the first, the whole's beyond the second
};
