// Views, four words a texel. At a place that is no constant a software device reads a uniform buffer word by word and lane
// by lane, some 35 instructions each; a texel is 45. And a fetched texel stays where the shader fetches it, so that
// kernels of many pixels take up a view once, before their loops.
layout(binding = 5) uniform usamplerBuffer view_words;

vec4 view_part(int at) { return uintBitsToFloat(texelFetch(view_words, at)); }
ivec4 view_indices(int at) { return ivec4(texelFetch(view_words, at)); }

SurfaceData view_surface(int at) {
  return SurfaceData(view_part(at), view_part(at + 1), view_part(at + 2), view_indices(at + 3), view_indices(at + 4),
                     view_part(at + 5), view_part(at + 6), view_indices(at + 7));
}

LensData view_lens(int at) {
  return LensData(view_part(at), view_part(at + 1), view_part(at + 2), view_part(at + 3), view_indices(at + 4),
                  view_surface(at + 5), view_surface(at + 5 + kSurfaceTexels));
}

ViewData view_data(int view) {
  int at = kViewTexels * view;
  int eye = at + kLensTexels;
  int own = eye + 2;
  return ViewData(view_lens(at), EyeData(view_part(eye), view_part(eye + 1)), view_part(own), view_part(own + 1),
                  view_part(own + 2), view_part(own + 3), view_part(own + 4), view_part(own + 5), view_part(own + 6),
                  view_part(own + 7), view_part(own + 8), view_part(own + 9));
}
