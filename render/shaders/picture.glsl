// Where a picture's points are seen from the pupil. After lenses/gpu/sight_optics.h, in whichever precision that is.

#ifndef MAY_BE_VIRTUAL  // whether some view shows a headset's virtual image
#define MAY_BE_VIRTUAL true
#endif

// Tangents of the angles right and up of the picture's axis. at: parts of the picture from its upper left corner.
// tangents: as ViewData's.
vec2 tangents_at(vec4 tangents, vec2 at) {
  return vec2(mix(-tangents.x, tangents.y, at.x), mix(tangents.w, -tangents.z, at.y));
}

// Unit, primary axes. virtual_image, gaze: as ViewData's; depth: of the eye's centre of rotation behind the pupil.
vec3 picture_direction(mat3 axes, vec2 tangents, vec4 virtual_image, vec4 gaze, real depth) {
  vec3 direction = normalize(axes * vec3(tangents, real(-1)));
  if (MAY_BE_VIRTUAL && virtual_image.x > real(0)) {
    // A headset's pixel is a point of its virtual image, seen from where the pupil really is.
    vec3 point = vec3(real(0), real(0), virtual_image.y) + virtual_image.x * direction;
    vec3 pupil = turned_pupil(eye_turn(int(gaze.w), gaze.xyz, direction), depth);
    direction = normalize(point - pupil);
  }
  return direction;
}
