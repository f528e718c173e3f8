// The beam of a pixel, or of a block of them: all rays through its square, of FOOTPRINT_PIXELS a side. Whether it meets
// something that its middle ray does not show, a stroke or a wire that lies between the rays of all pixels around.
// Neighbouring rays run as the ray-transfer matrix says (pixel_beam); after pixel.glsl.

// What the middle ray meets: a face, taken as flat over the beam, or nothing.
struct SeenFace {
  bool met;
  uint material;
  vec3 point;
  vec3 normal;  // of unit length, towards either side
};

// The rays through the corners in turn; they agree with the middle one's direction to first order.
SceneRay corner_ray(SceneRay middle, Beam beam, int k) {
  vec2 c = vec2(k == 1 || k == 2 ? 0.5 : -0.5, k > 1 ? 0.5 : -0.5);
  return SceneRay(middle.origin + c.x * beam.start.across + c.y * beam.start.up,
                  middle.direction + c.x * beam.growth.across + c.y * beam.growth.up);
}

// How far along a corner's ray the seen face's plane is; beyond everything where the ray does not come to it.
float plane_distance(SceneRay ray, SeenFace seen) {
  float along = dot(ray.direction, seen.normal);
  float t = dot(seen.point - ray.origin, seen.normal) / (along == 0.0 ? 1e-20 : along);
  return seen.met && t > 0.0 ? t : kFarthest;
}

// Whether a convex quadrangle and the triangle (0, 0), (1, 0), (0, 1) share a point: no side of either parts them.
bool overlap(vec2 quad[4]) {
  vec4 u = vec4(quad[0].x, quad[1].x, quad[2].x, quad[3].x);
  vec4 v = vec4(quad[0].y, quad[1].y, quad[2].y, quad[3].y);
  bool apart = all(lessThan(u, vec4(0.0))) || all(lessThan(v, vec4(0.0))) || all(greaterThan(u + v, vec4(1.0)));
  for (int k = 0; k < 4; ++k) {
    vec2 from = quad[k];
    vec2 side = quad[(k + 1) & 3] - from;
    vec2 across = vec2(side.y, -side.x);
    across *= dot(quad[(k + 2) & 3] - from, across) < 0.0 ? -1.0 : 1.0;
    float base = -dot(from, across);
    apart = apart || (base < 0.0 && base + across.x < 0.0 && base + across.y < 0.0);
  }
  return !apart;
}

// Whether a triangle has a part in the beam that shows, in front of the seen face or in its plane, and looks different:
// another material, another slope or, alone in the depth, clearly nearer. The slope's and the depth's thresholds are
// those of neighbouring pixels (edge_test.glsl).
bool shows_in_beam(uint triangle, SceneRay middle, Beam beam, SeenFace seen) {
  int texel = int(triangle * kBvhTriangleTexels);
  vec4 corner = texelFetch(bvh_triangles, texel);
  vec3 e1 = texelFetch(bvh_triangles, texel + 1).xyz;
  vec4 last = texelFetch(bvh_triangles, texel + 2);
  vec3 e2 = last.xyz;
  uint flags = floatBitsToUint(last.w);
  vec3 normal = cross(e1, e2);
  bool other = !seen.met || floatBitsToUint(corner.w) != seen.material ||
               abs(dot(normal, seen.normal)) < 0.95 * length(normal);
  bool sound = (flags & kBvhBlends) == 0u && ((flags & kBvhCulled) == 0u || dot(normal, middle.direction) < 0.0);
  bool in_front = false;
  bool nearer = false;
  vec2 quad[4];
  for (int k = 0; k < 4; ++k) {
    SceneRay ray = corner_ray(middle, beam, k);
    vec3 p = cross(ray.direction, e2);
    float inverse = 1.0 / dot(e1, p);
    vec3 s = ray.origin - corner.xyz;
    vec3 q = cross(s, e1);
    quad[k] = vec2(dot(s, p), dot(ray.direction, q)) * inverse;
    float t = dot(e2, q) * inverse;
    sound = sound && t > 0.0 && t < kFarthest;
    float seen_t = plane_distance(ray, seen);
    // A few roundings of world coordinates: the back of a sheet of paper stays behind its front.
    in_front = in_front || t - seen_t <= 2e-6 * (t + length(ray.origin));
    nearer = nearer || t < 0.95 * seen_t;
  }
  return sound && in_front && (other || nearer) && overlap(quad);
}

// Any triangle of the tree that shows in the beam. Boxes grow by the beam's half width where they end.
bool beam_shows_more(SceneRay middle, Beam beam, SeenFace seen) {
  float reach = 0.0;
  for (int k = 0; k < 4; ++k) {
    reach = max(reach, plane_distance(corner_ray(middle, beam, k), seen));
  }
  reach *= 1.0001;
  float width = 0.5 * (length(beam.start.across) + length(beam.start.up));
  float growth = 0.5 * (length(beam.growth.across) + length(beam.growth.up));
  vec3 direction = middle.direction;
  vec3 inverse = vec3(slab_inverse(direction.x), slab_inverse(direction.y), slab_inverse(direction.z));
  uint stack[kBvhStackSize];
  int top = 0;
  uint current = is_sound(middle.origin, direction) ? 0u : kTraversalDone;
  int steps = 0;
  bool found = false;
  // Loops ask at their end: on a software device one that asks at its start runs once more for nothing.
  do {
    do {
      if (current < kBvhLeafBit) {
        ++steps;
        int texel = int(current * kBvhNodeTexels);
        uvec4 q0 = texelFetch(bvh_nodes, texel);
        uvec4 q1 = texelFetch(bvh_nodes, texel + 1);
        uvec4 q2 = texelFetch(bvh_nodes, texel + 2);
        uvec4 child = texelFetch(bvh_nodes, texel + 3);
        vec3 start = vec3(uintBitsToFloat(q0.x), uintBitsToFloat(q0.y), uintBitsToFloat(q0.z)) - middle.origin;
        vec3 scale = vec3(uintBitsToFloat(q0.w), uintBitsToFloat(q1.x), uintBitsToFloat(q1.y));
        vec4 x0 = unpack_bytes(q1.z) * scale.x + start.x;
        vec4 x1 = unpack_bytes(q1.w) * scale.x + start.x;
        vec4 y0 = unpack_bytes(q2.x) * scale.y + start.y;
        vec4 y1 = unpack_bytes(q2.y) * scale.y + start.y;
        vec4 z0 = unpack_bytes(q2.z) * scale.z + start.z;
        vec4 z1 = unpack_bytes(q2.w) * scale.z + start.z;
        vec4 end = max(x0 * direction.x, x1 * direction.x) + max(y0 * direction.y, y1 * direction.y) +
                   max(z0 * direction.z, z1 * direction.z);
        vec4 grow = width + growth * clamp(end, 0.0, reach);
        vec4 ax = (x0 - grow) * inverse.x, bx = (x1 + grow) * inverse.x;
        vec4 ay = (y0 - grow) * inverse.y, by = (y1 + grow) * inverse.y;
        vec4 az = (z0 - grow) * inverse.z, bz = (z1 + grow) * inverse.z;
        vec4 entry = max(max(min(ax, bx), min(ay, by)), max(min(az, bz), vec4(0.0)));
        vec4 leave = min(min(max(ax, bx), max(ay, by)), min(max(az, bz), vec4(reach)));
        if (entry.x <= leave.x && child.x != kBvhNoChild) stack[top++] = child.x;
        if (entry.y <= leave.y && child.y != kBvhNoChild) stack[top++] = child.y;
        if (entry.z <= leave.z && child.z != kBvhNoChild) stack[top++] = child.z;
        if (entry.w <= leave.w && child.w != kBvhNoChild) stack[top++] = child.w;
        current = top > 0 ? stack[--top] : kTraversalDone;
      }
    } while (current < kBvhLeafBit && steps < kMaxTraversalSteps);
    do {
      if (current >= kBvhLeafBit && current != kTraversalDone) {
        uint first = (current >> kBvhLeafFirstShift) & kBvhLeafFirstMask;
        uint count = current & kBvhLeafCountMask;
        uint i = 0u;
        do {
          found = shows_in_beam(first + i, middle, beam, seen);
          ++i;
        } while (i < count && !found);
        current = top > 0 && !found ? stack[--top] : kTraversalDone;
      }
    } while (current >= kBvhLeafBit && current != kTraversalDone);
  } while (current != kTraversalDone && steps < kMaxTraversalSteps);
  return found;
}

const uint kShowsAnything = 0xffffffffu;

// at: the beam's middle, pixels from the picture's upper left corner. shown: a key (pack_key) of what the rays of pixels
// show; where the beam's own middle ray shows another material or status, that is more already. Or kShowsAnything.
bool square_shows_more(ViewData view, vec2 at, uint shown) {
  PixelRay ray = aim_pixel(view, pixel_direction(view, at), vec2(0.0), vec2(0.0));
  if (shown != kShowsAnything && uint(ray.status) != ((shown >> 12) & 15u)) {
    return true;
  }
  if (shows_rim(ray.status)) {
    return false;
  }
  take_transfer(view, ray);
  SceneRay middle = scene_ray(view, ray);
  ray_kind = kRaySolid;
  Hit hit;
  SeenFace seen = SeenFace(trace_closest(middle.origin, middle.direction, kFarthest, hit), 0u, vec3(0.0), vec3(0.0));
  if (seen.met) {
    int texel = int(hit.triangle * kBvhTriangleTexels);
    seen.material = hit.material;
    seen.point = middle.origin + hit.t * middle.direction;
    seen.normal = normalize(cross(texelFetch(bvh_triangles, texel + 1).xyz, texelFetch(bvh_triangles, texel + 2).xyz));
  }
  uint material = seen.met ? seen.material & 0xfffu : 0xfffu;
  bool other = shown != kShowsAnything && material != (shown & 0xfffu);
  return other || beam_shows_more(middle, pixel_beam(view, ray), seen);
}
