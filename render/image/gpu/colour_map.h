// Colour maps, one text for C++ and GLSL. Values are display-encoded sRGB: they go to the screen as they are.
#ifndef VERGENCE_RENDER_COLOUR_MAP_H
#define VERGENCE_RENDER_COLOUR_MAP_H

#ifdef __cplusplus
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#define VERGENCE_COLOUR_FUNCTION inline
namespace render::gpu {
using glm::abs;
using glm::clamp;
using glm::min;
using glm::mix;
using glm::vec3;
#else
#define VERGENCE_COLOUR_FUNCTION
#endif

const int kHueMap = 0;
const int kPerceptualMap = 1;

// Viridis (S. van der Walt and N. Smith, 2015, CC0), every 17th of its 256 colours.
const vec3 kPerceptualKnots[16] = {
    vec3(0.267F, 0.005F, 0.329F), vec3(0.283F, 0.100F, 0.422F), vec3(0.277F, 0.185F, 0.490F),
    vec3(0.254F, 0.265F, 0.530F), vec3(0.222F, 0.339F, 0.549F), vec3(0.191F, 0.407F, 0.556F),
    vec3(0.164F, 0.471F, 0.558F), vec3(0.139F, 0.534F, 0.555F), vec3(0.121F, 0.596F, 0.544F),
    vec3(0.135F, 0.659F, 0.518F), vec3(0.208F, 0.719F, 0.473F), vec3(0.328F, 0.774F, 0.407F),
    vec3(0.478F, 0.821F, 0.318F), vec3(0.647F, 0.858F, 0.210F), vec3(0.825F, 0.885F, 0.106F),
    vec3(0.993F, 0.906F, 0.144F)};

// The hue circle from blue (240 deg) down to red (0 deg) at full saturation and value (paper, section 6.1).
VERGENCE_COLOUR_FUNCTION vec3 hue_map(float x) {
  float sextant = 4.0F * (1.0F - x);
  vec3 colour = vec3(abs(sextant - 3.0F) - 1.0F, 2.0F - abs(sextant - 2.0F), 2.0F - abs(sextant - 4.0F));
  return clamp(colour, vec3(0.0F), vec3(1.0F));
}

VERGENCE_COLOUR_FUNCTION vec3 perceptual_map(float x) {
  float place = 15.0F * x;
  int knot = min(int(place), 14);
  return mix(kPerceptualKnots[knot], kPerceptualKnots[knot + 1], place - float(knot));
}

// x01 is clamped to 0..1; what is not a number counts as 0.
VERGENCE_COLOUR_FUNCTION vec3 colour_map(int which, float x01) {
  float x = x01 > 0.0F ? min(x01, 1.0F) : 0.0F;
  return which == kHueMap ? hue_map(x) : perceptual_map(x);
}

#ifdef __cplusplus
}  // namespace render::gpu
#endif
#undef VERGENCE_COLOUR_FUNCTION

#endif
