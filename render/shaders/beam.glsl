// The beam of a block of pixels: all rays through its square, of FOOTPRINT_PIXELS a side. Whether it meets
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

// A beam as the tree's boxes meet it: they grow by its half width where they end.
struct BeamReach {
  vec3 inverse;  // of the middle ray's direction
  float width;
  float growth;  // of the width with distance
  float far;     // what lies beyond does not count
};

BeamReach beam_reach(SceneRay middle, Beam beam, float far) {
  return BeamReach(vec3(slab_inverse(middle.direction.x), slab_inverse(middle.direction.y),
                        slab_inverse(middle.direction.z)),
                   0.5 * (length(beam.start.across) + length(beam.start.up)),
                   0.5 * (length(beam.growth.across) + length(beam.growth.up)), far);
}

const int kBoxMissed = 0x7FFFFFFF;

// A node's children: where the beam enters each, as the bits of a float, or kBoxMissed.
struct BeamBoxes {
  ivec4 entry;
  uvec4 child;
};

BeamBoxes beam_boxes(uint node, SceneRay middle, BeamReach beam) {
  int texel = int(node * kBvhNodeTexels);
  uvec4 q0 = texelFetch(bvh_nodes, texel);
  uvec4 q1 = texelFetch(bvh_nodes, texel + 1);
  uvec4 q2 = texelFetch(bvh_nodes, texel + 2);
  uvec4 child = texelFetch(bvh_nodes, texel + 3);
  vec3 start = vec3(uintBitsToFloat(q0.x), uintBitsToFloat(q0.y), uintBitsToFloat(q0.z)) - middle.origin;
  vec3 scale = vec3(uintBitsToFloat(q0.w), uintBitsToFloat(q1.x), uintBitsToFloat(q1.y));
  // The sides that a ray comes to first and last; each slab's are in order.
  bvec3 along = greaterThan(beam.inverse, vec3(0.0));
  vec4 near_x = unpack_bytes(along.x ? q1.z : q1.w) * scale.x + start.x;
  vec4 near_y = unpack_bytes(along.y ? q2.x : q2.y) * scale.y + start.y;
  vec4 near_z = unpack_bytes(along.z ? q2.z : q2.w) * scale.z + start.z;
  vec4 far_x = unpack_bytes(along.x ? q1.w : q1.z) * scale.x + start.x;
  vec4 far_y = unpack_bytes(along.y ? q2.y : q2.x) * scale.y + start.y;
  vec4 far_z = unpack_bytes(along.z ? q2.w : q2.z) * scale.z + start.z;
  vec4 end = far_x * middle.direction.x + far_y * middle.direction.y + far_z * middle.direction.z;
  end = mix(end, vec4(0.0), lessThan(end, vec4(0.0)));
  end = mix(end, vec4(beam.far), greaterThan(end, vec4(beam.far)));
  vec4 grow = beam.width + beam.growth * end;
  vec3 steep = abs(beam.inverse);
  ivec4 entry = max(max(floatBitsToInt(near_x * beam.inverse.x - grow * steep.x),
                        floatBitsToInt(near_y * beam.inverse.y - grow * steep.y)),
                    max(floatBitsToInt(near_z * beam.inverse.z - grow * steep.z), ivec4(0)));
  ivec4 leave = min(min(floatBitsToInt(far_x * beam.inverse.x + grow * steep.x),
                        floatBitsToInt(far_y * beam.inverse.y + grow * steep.y)),
                    min(floatBitsToInt(far_z * beam.inverse.z + grow * steep.z), ivec4(floatBitsToInt(beam.far))));
  return BeamBoxes(ivec4(entry.x <= leave.x && child.x != kBvhNoChild ? entry.x : kBoxMissed,
                         entry.y <= leave.y && child.y != kBvhNoChild ? entry.y : kBoxMissed,
                         entry.z <= leave.z && child.z != kBvhNoChild ? entry.z : kBoxMissed,
                         entry.w <= leave.w && child.w != kBvhNoChild ? entry.w : kBoxMissed),
                   child);
}

// Any triangle of the tree that shows in the beam.
bool beam_shows_more(SceneRay middle, Beam beam, SeenFace seen) {
  float far = 0.0;
  for (int k = 0; k < 4; ++k) {
    far = max(far, plane_distance(corner_ray(middle, beam, k), seen));
  }
  BeamReach reach = beam_reach(middle, beam, far * 1.0001);
  uint stack[kBvhStackSize];
  int top = 0;
  uint current = is_sound(middle.origin, middle.direction) ? 0u : kTraversalDone;
  int steps = 0;
  bool found = false;
  // Loops ask at their end: on a software device one that asks at its start runs once more for nothing.
  do {
    do {
      if (current < kBvhLeafBit) {
        ++steps;
        BeamBoxes boxes = beam_boxes(current, middle, reach);
        if (boxes.entry.x != kBoxMissed) stack[top++] = boxes.child.x;
        if (boxes.entry.y != kBoxMissed) stack[top++] = boxes.child.y;
        if (boxes.entry.z != kBoxMissed) stack[top++] = boxes.child.z;
        if (boxes.entry.w != kBoxMissed) stack[top++] = boxes.child.w;
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

// at: the beam's middle, pixels from the picture's upper left corner. shown: a key (pack_key) of what the rays of pixels
// show; where the beam's own middle ray shows another material or status, that is more already.
bool square_shows_more(ViewData view, vec2 at, uint shown) {
  PixelRay ray = aim_pixel(view, pixel_direction(view, at), vec2(0.0), vec2(0.0));
  if (uint(ray.status) != ((shown >> 12) & 15u)) {
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
  bool other = material != (shown & 0xfffu);
  return other || beam_shows_more(middle, pixel_beam(view, ray), seen);
}
