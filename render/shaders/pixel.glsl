// One ray of a pixel, all the way: pupil, back, front, scene, and the wavefront back at the pupil.

struct PixelRay {
  SightLine line;  // in the eye's primary axes
  int status;
  vec3 radiance;
  float depth;     // m along the refracted ray, 0 = sky, -1 = none
  vec3 normal;
  uint material;
};

const vec3 kRimRadiance = vec3(0.015);

mat3 picture_axes(ViewData view) { return mat3(view.picture_x.xyz, view.picture_y.xyz, view.picture_z.xyz); }

// at: pixels from the picture's upper left corner. Tangents of the angles right and up of the picture's axis.
vec2 picture_tangents(ViewData view, vec2 at) {
  vec2 size = vec2(float(frame.size.x), float(frame.size.y));
  return vec2(mix(-view.tangents.x, view.tangents.y, at.x / size.x), mix(view.tangents.w, -view.tangents.z, at.y / size.y));
}

// The direction in primary axes that a pixel stands for, from the pupil.
vec3 pixel_direction(ViewData view, vec2 at) {
  vec3 direction = normalize(picture_axes(view) * vec3(picture_tangents(view, at), -1.0));
  if (view.virtual_image.x > 0.0) {
    // A headset's pixel is a point of its virtual image, seen from where the pupil really is.
    vec3 point = vec3(0.0, 0.0, view.virtual_image.y) + view.virtual_image.x * direction;
    int viewing = int(view.gaze.w);
    vec3 pupil = turned_pupil(eye_turn(viewing, view.gaze.xyz, direction), view.eye.pupil.y);
    direction = normalize(point - pupil);
  }
  return direction;
}

vec3 world_direction(ViewData view, vec3 d) { return view.world_x.xyz * d.x + view.world_y.xyz * d.y + view.world_z.xyz * d.z; }

vec3 world_point(ViewData view, vec3 p) {
  return world_direction(view, p) + vec3(view.world_x.w, view.world_y.w, view.world_z.w);
}

bool shows_rim(int status) {
  return status == kStatusInverted || status == kStatusTirFront || status == kStatusMissFront || status == kStatusSingular;
}

// The ray that goes on into the scene, world; direction of unit length.
struct SceneRay {
  vec3 origin;
  vec3 direction;
};

// The line of sight up to the scene: everything but what it meets there. A rim's is complete.
PixelRay aim_pixel(ViewData view, vec3 direction, vec2 pupil_offset, vec2 momentum) {
  PixelRay ray;
  mat3 turn = eye_turn(int(view.gaze.w), view.gaze.xyz, direction);
  ray.line = trace_sight_line(view.lens, view.eye, turn, direction, pupil_offset, momentum);
  ray.status = ray.line.status;
  ray.normal = vec3(0.0);
  ray.material = 0xffffu;
  ray.radiance = kRimRadiance;
  ray.depth = -1.0;
  return ray;
}

SceneRay scene_ray(ViewData view, PixelRay ray) {
  return SceneRay(world_point(view, ray.line.start), normalize(world_direction(view, ray.line.direction_object)));
}

// Completes a ray that is no rim with what it met.
void see(ViewData view, inout PixelRay ray, SceneRay beyond, bool found, Hit hit) {
  if (found) {
    Surface surface = shade_hit(hit, beyond.origin, beyond.direction);
    ray.radiance = surface.radiance;
    ray.normal = surface.normal;
    ray.material = hit.material;
    ray.depth = hit.t;
  } else {
    ray.radiance = sky_radiance(beyond.direction);
    ray.depth = 0.0;
  }
  if (view.lens.glass.w != 0.0 && ray.status == kStatusOk) {
    ray.radiance *= view.tint.rgb;
  }
  // Half floats end at 65504; nothing may leave as an infinity.
  ray.radiance = clamp(ray.radiance, vec3(0.0), vec3(65000.0));
}

PixelRay trace_pixel(ViewData view, vec3 direction, vec2 pupil_offset, vec2 momentum) {
  PixelRay ray = aim_pixel(view, direction, pupil_offset, momentum);
  if (!shows_rim(ray.status)) {
    SceneRay beyond = scene_ray(view, ray);
    Hit hit;
    bool found = trace_closest(beyond.origin, beyond.direction, 1e30, hit);
    see(view, ray, beyond, found, hit);
  }
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
    RayTransfer transfer = sight_line_transfer(view.lens, ray.line);
    w.vergence = sight_line_vergence(transfer, q, ray.status);
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

// What tells an edge: material, status and the face's normal in 5 bits a component.
uint pack_key(PixelRay ray) {
  uvec3 n = uvec3(round((ray.normal * 0.5 + 0.5) * 31.0));
  return (ray.material & 0xfffu) | (uint(ray.status) << 12) | (n.x << 16) | (n.y << 21) | (n.z << 26);
}
