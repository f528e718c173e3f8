#version 460
#extension GL_GOOGLE_include_directive : require
// The ray of every pixel beyond the lens, the chief one with its ray-transfer matrix or a sample, in double precision up
// to where it is stored.
#include "render/shaders/frame.h"
#include "render/shaders/double_view.h"
#include "render/shaders/sample_pattern.h"

layout(constant_id = 0) const uint kSurfaceKinds = 0xffffffffu;  // as scene_bindings.glsl
#define BACK_KINDS (kSurfaceKinds & 0xffffu)
#define FRONT_KINDS ((kSurfaceKinds >> 16) & 0x7fffu)
#define MAY_CROSS ((kSurfaceKinds >> 31) != 0u)
layout(constant_id = 5) const uint kLensIterations = 0u;
#define NEWTON_STEPS int(kLensIterations)
layout(constant_id = 8) const uint kSampled = 0u;  // as aim.glsl

layout(local_size_x = 8, local_size_y = 8) in;
// Doubles as pairs of words: neither texels nor, without more of a device, structures hold them as they are.
layout(binding = 0) uniform usamplerBuffer lens_table;
layout(std140, binding = 1) uniform Views { uvec4 view_words[2 * kDoubleView * 4]; };
layout(std430, binding = 2) writeonly buffer Origins { vec4 origins[]; };  // as ray_out.glsl
layout(std430, binding = 3) writeonly buffer Directions { vec4 directions[]; };
layout(std430, binding = 4) writeonly buffer Kept { vec4 kept[]; };
layout(binding = 5) uniform samplerBuffer kept_wavefronts;
layout(push_constant) uniform Frame { FrameData frame; };
#define SHOWN_TILES_AT 6
#include "render/shaders/group.glsl"

dvec4 doubles(uvec4 a, uvec4 b) {
  return dvec4(packDouble2x32(a.xy), packDouble2x32(a.zw), packDouble2x32(b.xy), packDouble2x32(b.zw));
}
dvec4 table_at(int i) { return doubles(texelFetch(lens_table, 2 * i), texelFetch(lens_table, 2 * i + 1)); }
dvec4 view_at(int i) {
  int word = 2 * (kDoubleView * frame.view.x + i);
  return doubles(view_words[word], view_words[word + 1]);
}

// xy: on the unit disc of the pupil; zw: within the pixel.
dvec4 sample_at(ivec2 p) {
  vec4 u = sample_pattern(frame.sample_point, uint(frame.sampling.x), uvec2(p), uint(frame.sampling.z));
  return dvec4(to_disc(u.xy), u.zw);
}

#define real double
#define vec2 dvec2
#define vec3 dvec3
#define vec4 dvec4
#define mat2 dmat2
#define mat3 dmat3
#define TABLE_AT(i) table_at(i)
const real kEpsilon = 2.220446049250313e-16lf;
#include "lenses/gpu/sight_optics.h"
#include "render/shaders/picture.glsl"

mat3 axes_at(int i) { return mat3(view_at(i).xyz, view_at(i + 1).xyz, view_at(i + 2).xyz); }

SurfaceData surface_at(int i) {
  return SurfaceData(view_at(i), view_at(i + 1), view_at(i + 2), ivec4(view_at(i + 3)), ivec4(view_at(i + 4)),
                     view_at(i + 5), view_at(i + 6), ivec4(view_at(i + 7)));
}

LensData lens_at(int i) {
  return LensData(view_at(i), view_at(i + 1), view_at(i + 2), view_at(i + 3), ivec4(view_at(i + 4)),
                  surface_at(kDoubleBackAt), surface_at(kDoubleFrontAt));
}

// aim.glsl's rays in double precision. accommodation: of the chief ray, where each has its own.
SightLine traced_line(LensData lens, ivec2 p, real accommodation) {
  EyeData eye = EyeData(view_at(kDoubleExcessAt), view_at(kDoublePupilAt));
  vec2 within = vec2(real(0.5));
  vec2 offset = vec2(real(0));
  vec2 momentum = vec2(real(0));
  if (kSampled != 0u) {
    vec4 u = sample_at(p);
    within = u.zw;
    offset = real(0.5) * eye.pupil.x * u.xy;
    real state = eye.pupil.z >= real(0) ? eye.pupil.z : accommodation;
    vec3 excess = eye.excess.xyz + vec3(state, real(0), state);
    momentum = -vec2(dot(excess.xy, offset), dot(excess.yz, offset));
  }
  vec4 gaze = view_at(kDoubleGazeAt);
  vec2 tangents = tangents_at(view_at(kDoubleTangentsAt), (vec2(p) + within) / vec2(frame.size.xy));
  vec3 direction =
      picture_direction(axes_at(kDoublePictureAt), tangents, view_at(kDoubleVirtualImageAt), gaze, eye.pupil.y);
  mat3 turn = eye_turn(int(gaze.w), gaze.xyz, direction);
  return trace_sight_line(lens, eye, turn, direction, offset, momentum);
}

RayTransfer traced_transfer(LensData lens, SightLine line) {
  vec3 upright = upright_axis(line.e_h, line.direction_object);
  return turned_transfer(sight_line_transfer(lens, line), transfer_axis(lens, line), upright, line.direction_object);
}
#undef vec2
#undef vec3
#undef vec4
#undef mat2
#undef mat3

bool is_finite(dvec3 v) { return all(lessThan(abs(v), dvec3(1e30))); }

void main() {
  ivec2 p = pixel_in_order();
  int eye = frame.view.x;
  if (p.x >= frame.size.x || p.y >= frame.size.y) {
    return;
  }
  int at = (eye * frame.size.y + p.y) * frame.size.x + p.x;
  LensData lens = lens_at(kDoubleLensAt);
  double accommodation = kSampled != 0u ? texelFetch(kept_wavefronts, kWavefrontTexels * at).w : 0.0lf;
  SightLine line = traced_line(lens, p, accommodation);
  dmat3 world = axes_at(kDoubleWorldAt);
  dvec3 eye_place = dvec3(view_at(kDoubleWorldAt).w, view_at(kDoubleWorldAt + 1).w, view_at(kDoubleWorldAt + 2).w);
  dvec3 origin = world * line.start + eye_place;
  dvec3 direction = normalize(world * line.direction_object);
  // As ray_out.glsl leaves a ray.
  bool through = LENS_USED && lens.glass.w != 0.0lf && line.status == kStatusOk;
  vec2 lengths = through ? vec2(line.path.t_back, line.path.t_front) : vec2(0.0);
  if (line.status != kStatusOk && line.status != kStatusMissBack) {
    lengths.y = -float(line.status);
  } else if (!is_finite(origin) || !is_finite(direction)) {
    lengths.y = -float(kStatusSingular);
  }
  origins[at] = vec4(vec3(origin), lengths.x);
  directions[at] = vec4(vec3(direction), lengths.y);
  if (through && kSampled == 0u) {
    RayTransfer m = traced_transfer(lens, line);
    kept[kTransferTexels * at] = vec4(vec2(m.a[0]), vec2(m.a[1]));
    kept[kTransferTexels * at + 1] = vec4(vec2(m.b[0]), vec2(m.b[1]));
    kept[kTransferTexels * at + 2] = vec4(vec2(m.c[0]), vec2(m.c[1]));
    kept[kTransferTexels * at + 3] = vec4(vec2(m.d[0]), vec2(m.d[1]));
  }
}
