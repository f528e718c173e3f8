// One ray of a pixel, all the way: pupil, back, front, scene, and the wavefront back at the pupil.

#include "render/shaders/picture.glsl"

struct PixelRay {
  SightLine line;  // in the eye's primary axes
  int status;
  vec3 radiance;
  float depth;     // m along the refracted ray, 0 = sky, -1 = none
  vec3 normal;
  uint material;
  RayTransfer transfer;  // from the pupil to where the ray leaves for the scene
  vec3 across;           // the first axis of its basis there
};

// What one ray's texture samples average over, in pixels: less where several rays share a pixel.
#ifndef FOOTPRINT_PIXELS
#define FOOTPRINT_PIXELS 1.0
#endif

// True where the rays come with their ray-transfer matrices.
#ifndef TRANSFER_IS_KEPT
#define TRANSFER_IS_KEPT false
#endif

const vec3 kRimRadiance = vec3(0.015);

mat3 picture_axes(ViewData view) { return mat3(view.picture_x.xyz, view.picture_y.xyz, view.picture_z.xyz); }

// at: pixels from the picture's upper left corner. The direction in primary axes that it stands for, from the pupil.
vec3 pixel_direction(ViewData view, vec2 at) {
  vec2 tangents = tangents_at(view.tangents, at / vec2(frame.size.xy));
  return picture_direction(picture_axes(view), tangents, view.virtual_image, view.gaze, view.eye.pupil.y);
}

vec3 world_direction(ViewData view, vec3 d) { return view.world_x.xyz * d.x + view.world_y.xyz * d.y + view.world_z.xyz * d.z; }

vec3 world_point(ViewData view, vec3 p) {
  return world_direction(view, p) + vec3(view.world_x.w, view.world_y.w, view.world_z.w);
}

bool shows_rim(int status) {
  return status == kStatusInverted || status == kStatusTirFront || status == kStatusMissFront || status == kStatusSingular;
}

// Where neighbouring pixels' rays run beside this one: offsets across the ray, where it leaves for the scene and more
// for each metre (world). A pixel's step in direction, taken through the ray-transfer matrix.
struct Beam {
  Footprint start;
  Footprint growth;
};

Beam pixel_beam(ViewData view, PixelRay ray) {
  SightLine line = ray.line;
  vec3 w1 = world_direction(view, ray.across);
  vec3 w2 = world_direction(view, cross(ray.across, line.direction_object));
  float cosine = -dot(line.direction, view.picture_z.xyz);
  float step_x = FOOTPRINT_PIXELS * cosine * (view.tangents.x + view.tangents.y) / float(frame.size.x);
  float step_y = FOOTPRINT_PIXELS * cosine * (view.tangents.z + view.tangents.w) / float(frame.size.y);
  vec2 px = step_x * vec2(dot(view.picture_x.xyz, line.e_h), dot(view.picture_x.xyz, line.e_v));
  vec2 py = step_y * vec2(dot(view.picture_y.xyz, line.e_h), dot(view.picture_y.xyz, line.e_v));
  // The scanning eye's pupil moves along with the direction.
  float pupil = IS_VIEWING(int(view.gaze.w), kViewingScanning) ? view.eye.pupil.y : 0.0;
  mat2 x = ray.transfer.b + pupil * ray.transfer.a;
  mat2 p = ray.transfer.d + pupil * ray.transfer.c;
  vec2 x_across = x * px;
  vec2 x_up = x * py;
  vec2 p_across = p * px;
  vec2 p_up = p * py;
  Beam beam;
  beam.start = Footprint(x_across.x * w1 + x_across.y * w2, x_up.x * w1 + x_up.y * w2);
  beam.growth = Footprint(p_across.x * w1 + p_across.y * w2, p_up.x * w1 + p_up.y * w2);
  return beam;
}

// A ray that goes on into the scene: m, world; direction of unit length.
struct SceneRay {
  vec3 origin;
  vec3 direction;
};

SceneRay scene_ray(ViewData view, PixelRay ray) {
  return SceneRay(world_point(view, ray.line.start), renormalized(world_direction(view, ray.line.direction_object)));
}

// A ray before it has met anything: a rim's is complete.
PixelRay unseen_ray(SightLine line) {
  PixelRay ray;
  ray.line = line;
  ray.status = line.status;
  ray.normal = vec3(0.0);
  ray.material = 0xffffu;
  ray.radiance = kRimRadiance;
  ray.depth = -1.0;
  ray.transfer = free_flight(0.0);
  ray.across = line.e_h;
  return ray;
}

PixelRay aim_pixel(ViewData view, vec3 direction, vec2 pupil_offset, vec2 momentum) {
  mat3 turn = eye_turn(int(view.gaze.w), view.gaze.xyz, direction);
  return unseen_ray(trace_sight_line(view.lens, view.eye, turn, direction, pupil_offset, momentum));
}

void take_transfer(ViewData view, inout PixelRay ray) {
  if (ray.status == kStatusOk) {
    ray.transfer = sight_line_transfer(view.lens, ray.line);
    ray.across = transfer_axis(view.lens, ray.line);
  }
}

struct Sight {
  vec3 radiance;
  float depth;  // as PixelRay's
  vec3 normal;
  uint material;
};

// The layers along a ray, front to back; what blends lets the rest through. Depth, normal and material are those of the
// layer that the eye sees most of: the first with more than half of the light in front of its back. known: `met` and
// `hit` say already what the first layer is.
Sight look_along(SceneRay beyond, Beam beam, bool known, bool met, Hit hit) {
  Sight sight;
  vec3 radiance = vec3(0.0);
  float through = 1.0;
  float before = 0.0;  // m from where the ray left for the scene
  bool decided = false;
  uint first_material = 0u;
  const int layers = HAS(kFeatureBlend) ? kMostLayers : 1;
  for (int layer = 0; layer < layers; ++layer) {
    if (layer > 0 || !known) {
      met = trace_closest(beyond.origin, beyond.direction, kFarthest, hit);
    }
    Surface surface;
    surface.radiance = vec3(0.0);
    surface.normal = vec3(0.0);
    surface.alpha = 1.0;
    float depth = 0.0;
    if (met) {
      depth = before + hit.t;
      Footprint footprint;
      if (HAS(kFeatureTexture)) {
        footprint.across = beam.start.across + depth * beam.growth.across;
        footprint.up = beam.start.up + depth * beam.growth.up;
      }
      surface = shade_hit(hit, beyond.origin, beyond.direction, footprint);
    } else {
      surface.radiance = sky_radiance(beyond.direction);
    }
    bool last = layer + 1 == layers || surface.alpha >= 1.0;
    float share = last ? through : through * surface.alpha;
    radiance += share * surface.radiance;
    through -= share;
    if (!decided && (last || through <= 0.5)) {
      decided = true;
      sight.depth = depth;
      sight.normal = surface.normal;
      sight.material = met ? hit.material : 0xffffu;
      if (layer > 0) {
        sight.material ^= (first_material + 1u) << 5;  // the edge of a pane is an edge
      }
    }
    if (last || through < 1.0 / 512.0) {
      break;
    }
    first_material = layer == 0 ? hit.material : first_material;
    float on = hit.t + lift(beyond.origin + hit.t * beyond.direction);
    beyond.origin += on * beyond.direction;
    before += on;
  }
  sight.radiance = radiance;
  return sight;
}

// What the spectacles' tint lets through. Half floats end at 65504; nothing may leave as an infinity.
vec3 seen_radiance(ViewData view, int status, vec3 radiance) {
  if (view.lens.glass.w != 0.0 && status == kStatusOk) {
    radiance *= view.tint.rgb;
  }
  return clamp(radiance, vec3(0.0), vec3(65000.0));
}

// Completes a ray that is no rim.
void see(ViewData view, inout PixelRay ray, SceneRay beyond, bool known, bool met, Hit hit) {
  if (!TRANSFER_IS_KEPT) {
    take_transfer(view, ray);
  }
  Beam beam;
  if (HAS(kFeatureTexture)) {
    beam = pixel_beam(view, ray);
  }
  Sight sight = look_along(beyond, beam, known, met, hit);
  ray.radiance = seen_radiance(view, ray.status, sight.radiance);
  ray.depth = sight.depth;
  ray.normal = sight.normal;
  ray.material = sight.material;
}

PixelRay trace_pixel(ViewData view, vec3 direction, vec2 pupil_offset, vec2 momentum) {
  PixelRay ray = aim_pixel(view, direction, pupil_offset, momentum);
  if (shows_rim(ray.status)) {
    return ray;
  }
  SceneRay beyond = scene_ray(view, ray);
  Hit none;
  see(view, ray, beyond, false, false, none);
  return ray;
}

struct PixelWavefront {
  vec3 vergence;
  EyeResponse response;
};

// V at the pupil for what the pixel's ray met; a ray beside the lens has the bare eye's, a rim none.
PixelWavefront pixel_wavefront(ViewData view, inout PixelRay ray) {
  PixelWavefront w;
  w.vergence = vec3(0.0);
  float q = ray.depth > 0.0 ? 1.0 / max(ray.depth, 1e-6) : 0.0;
  if (ray.status == kStatusOk) {
    w.vergence = sight_line_vergence(ray.transfer, q, ray.status);
  } else if (ray.status == kStatusMissBack) {
    w.vergence = vec3(-q, 0.0, -q);
  }
  if (shows_rim(ray.status)) {
    ray.radiance = kRimRadiance;
    ray.depth = -1.0;
    w.vergence = vec3(0.0);
    w.response.accommodation = 0.0;
    w.response.residual = vec3(0.0);
    w.response.blur = vec2(0.0);
    w.response.blur_axis = 0.0;
    return w;
  }
  float accommodation = view.eye.pupil.z >= 0.0 ? view.eye.pupil.z : clamped_accommodation(w.vergence, view.eye);
  w.response = eye_response(w.vergence, view.eye, accommodation);
  return w;
}

// The blur in pixels: the symmetric matrix that takes the unit disc to the ellipse (a/2) |R| seen in the picture.
vec3 blur_in_pixels(ViewData view, PixelRay ray, vec3 residual) {
  mat3 to_picture = transpose(picture_axes(view));
  vec3 d = to_picture * ray.line.direction;
  vec3 h = to_picture * ray.line.e_h;
  vec3 v = to_picture * ray.line.e_v;
  vec2 at = d.xy / -d.z;
  vec2 focal = vec2(float(frame.size.x) / (view.tangents.x + view.tangents.y),
                    -float(frame.size.y) / (view.tangents.z + view.tangents.w));
  vec2 along_h = focal * (h.xy + at * h.z) / -d.z;
  vec2 along_v = focal * (v.xy + at * v.z) / -d.z;
  float half_pupil = 0.5 * view.eye.pupil.x;
  vec2 a = half_pupil * (residual.x * along_h + residual.y * along_v);  // columns of G = (a/2) J R
  vec2 b = half_pupil * (residual.y * along_h + residual.z * along_v);
  // The root of G G^T: (M + sqrt(det M)) / sqrt(tr M + 2 sqrt(det M)).
  vec3 m = vec3(a.x * a.x + b.x * b.x, a.x * a.y + b.x * b.y, a.y * a.y + b.y * b.y);
  float root = abs(a.x * b.y - a.y * b.x);
  float scale = sqrt(m.x + m.z + 2.0 * root);
  vec3 s = scale > 1e-12 ? vec3(m.x + root, m.y, m.z + root) / scale : vec3(0.0);
  float largest = max(abs(s.x), abs(s.z)) + abs(s.y);
  return largest > frame.limits.y ? s * (frame.limits.y / largest) : s;
}

uvec4 pack_pixel(vec3 radiance, vec3 ellipse, float depth) {
  return uvec4(packHalf2x16(radiance.rg), packHalf2x16(vec2(radiance.b, ellipse.x)), packHalf2x16(ellipse.yz),
               floatBitsToUint(depth));
}

// What tells an edge: material, status and the face's normal in 5 bits a component; beside them the luminance.
uvec2 pack_key(PixelRay ray) {
  uvec3 n = uvec3(round((ray.normal * 0.5 + 0.5) * 31.0));
  uint kind = (ray.material & 0xfffu) | (uint(ray.status) << 12) | (n.x << 16) | (n.y << 21) | (n.z << 26);
  return uvec2(kind, floatBitsToUint(dot(ray.radiance, vec3(0.2126, 0.7152, 0.0722))));
}
