// A view in double precision, as a list of vec4 that C++ lays down and rays_double.comp.glsl reads. Integers are stored
// as numbers.
const int kDoublePictureAt = 0;  // columns of eye_from_picture
const int kDoubleTangentsAt = 3;
const int kDoubleGazeAt = 4;
const int kDoubleWorldAt = 5;  // columns of world_from_eye; w: the translation's components
const int kDoubleVirtualImageAt = 8;
const int kDoubleExcessAt = 9;  // EyeData's
const int kDoublePupilAt = 10;
const int kDoubleLensAt = 11;  // axes, glass, mount
const int kDoubleBackAt = 16;  // SurfaceData's members
const int kDoubleFrontAt = 24;
const int kDoubleView = 32;    // vec4 a view
