// What a pixel's square shows: the faces in its beam, and each one's part of the square, by 128 points in which the
// triangles hide each other. Flat over the square, as the pixel's rays run beside each other by the ray-transfer matrix;
// after beam.glsl.

// The points lie on 8 lines, 16 on each, across the square; a line climbs or falls by its distance from the next, so
// that level strokes count by their width as upright ones do. A line's points are 16 bits of a word, 4 words have all.
const float kLineRise = 1.0 / 8.0;

// How far along its line a line's first point is, in distances between points: other on every line.
float line_phase(int line) { return (float((5 * line) & 7) + 0.5) / 8.0; }

float line_height(int line) { return (float(line) + 0.5) / 8.0 - 0.5; }

// A point by its number: pixels from the square's middle to the right and up.
vec2 square_point(int number) {
  int line = number >> 4;
  float x = (float(number & 15) + line_phase(line)) / 16.0 - 0.5;
  return vec2(x, line_height(line) + ((line & 1) == 0 ? x : -x) * kLineRise);
}

// The points of a line up to x, as bits.
uint line_before(float x, float phase) {
  float count = 16.0 * x + 9.0 - phase;
  count = count < 0.0 ? 0.0 : count;
  count = count > 16.0 ? 16.0 : count;
  return (1u << uint(count)) - 1u;
}

// A triangle's three sides: what is positive within, in the square's middle and how it grows to the right and up.
struct Sides {
  vec3 middle, right, up;
};

uint line_within(Sides sides, int line, vec3 inverse) {
  vec3 crossed = (sides.middle + line_height(line) * sides.up) * -inverse;
  vec3 low = vec3(inverse.x > 0.0 ? crossed.x : -4.0, inverse.y > 0.0 ? crossed.y : -4.0,
                  inverse.z > 0.0 ? crossed.z : -4.0);
  vec3 high = vec3(inverse.x > 0.0 ? 4.0 : crossed.x, inverse.y > 0.0 ? 4.0 : crossed.y,
                   inverse.z > 0.0 ? 4.0 : crossed.z);
  float from = low.x > low.y ? low.x : low.y;
  from = from > low.z ? from : low.z;
  float to = high.x < high.y ? high.x : high.y;
  to = to < high.z ? to : high.z;
  float phase = line_phase(line);
  return line_before(to, phase) & ~line_before(from, phase);
}

uvec4 points_within(Sides sides) {
  vec3 rising = sides.right + kLineRise * sides.up;
  vec3 falling = sides.right - kLineRise * sides.up;
  vec3 up = vec3(slab_inverse(rising.x), slab_inverse(rising.y), slab_inverse(rising.z));
  vec3 down = vec3(slab_inverse(falling.x), slab_inverse(falling.y), slab_inverse(falling.z));
  return uvec4(line_within(sides, 0, up) | (line_within(sides, 1, down) << 16),
               line_within(sides, 2, up) | (line_within(sides, 3, down) << 16),
               line_within(sides, 4, up) | (line_within(sides, 5, down) << 16),
               line_within(sides, 6, up) | (line_within(sides, 7, down) << 16));
}

bool has_points(uvec4 points) { return (points.x | points.y | points.z | points.w) != 0u; }

int lowest_bit(uint bits) { return findLSB(bits); }

// Any of the points, one between two others of its line if there is one.
int point_among(uvec4 points) {
  uint bits = points.x;
  int first = 0;
  if (bitCount(points.y) > bitCount(bits)) {
    bits = points.y;
    first = 32;
  }
  if (bitCount(points.z) > bitCount(bits)) {
    bits = points.z;
    first = 64;
  }
  if (bitCount(points.w) > bitCount(bits)) {
    bits = points.w;
    first = 96;
  }
  uint between = bits & (bits << 1) & (bits >> 1) & 0x7ffe7ffeu;
  return first + lowest_bit(between != 0u ? between : bits);
}

// Faces of one material and about one slope, side by side, count as one.
struct SquareFace {
  uvec4 points;    // where it shows
  vec3 nearness;   // 1 / distance along the ray: in the middle, and how it grows to the right and up
  vec3 normal;     // of unit length, against the rays
  uint material;
  float reach;     // how far away it may be in the square
};

struct SquareFaces {
  SquareFace a, b, c, d;
  bool unknown;  // more than these, or what is not decided by where its sides are
};

// Of two faces that share points the nearer keeps them.
void hide_behind(inout SquareFace face, inout uvec4 points, vec3 nearness) {
  uvec4 both = face.points & points;
  uint bits = both.x != 0u ? both.x : both.y != 0u ? both.y : both.z != 0u ? both.z : both.w;
  int first = both.x != 0u ? 0 : both.y != 0u ? 32 : both.z != 0u ? 64 : 96;
  vec2 at = square_point(first + max(lowest_bit(bits), 0));
  bool in_front = dot(nearness - face.nearness, vec3(1.0, at)) > 0.0;
  face.points &= ~(in_front ? both : uvec4(0u));
  points &= ~(in_front ? uvec4(0u) : both);
}

// Gives the new face's points to one that is the same.
void join(inout SquareFace face, inout SquareFace more) {
  bool same = has_points(face.points) && face.material == more.material && dot(face.normal, more.normal) > 0.95 &&
              abs(face.nearness.x - more.nearness.x) < 0.05 * max(face.nearness.x, more.nearness.x);
  face.points |= same ? more.points : uvec4(0u);
  face.reach = same ? max(face.reach, more.reach) : face.reach;
  more.points = same ? uvec4(0u) : more.points;
}

// Puts the new face where none shows.
void settle(inout SquareFace face, inout SquareFace more) {
  bool room = !has_points(face.points);
  face.nearness = room ? more.nearness : face.nearness;
  face.normal = room ? more.normal : face.normal;
  face.material = room ? more.material : face.material;
  face.reach = room ? more.reach : face.reach;
  face.points = room ? more.points : face.points;
  more.points = room ? uvec4(0u) : more.points;
}

// u, v and the determinant of a ray of the beam against the triangle, and 1 / distance.
vec4 on_triangle(vec3 origin, vec3 direction, vec3 corner, vec3 e1, vec3 e2) {
  vec3 p = cross(direction, e2);
  vec3 s = origin - corner;
  vec3 q = cross(s, e1);
  float determinant = dot(e1, p);
  return vec4(dot(s, p), dot(direction, q), determinant, determinant * slab_inverse(dot(e2, q)));
}

// A triangle as the square sees it.
struct SquareTriangle {
  Sides sides;
  vec3 nearness;
  uint flags;
  uint material;
  bool front;
};

SquareTriangle triangle_in_square(uint triangle, SceneRay middle, Beam beam) {
  int texel = int(triangle * kBvhTriangleTexels);
  vec4 corner = texelFetch(bvh_triangles, texel);
  vec3 e1 = texelFetch(bvh_triangles, texel + 1).xyz;
  vec4 last = texelFetch(bvh_triangles, texel + 2);
  vec3 e2 = last.xyz;
  vec4 at = on_triangle(middle.origin, middle.direction, corner.xyz, e1, e2);
  vec4 right = 2.0 * (on_triangle(middle.origin + 0.5 * beam.start.across, middle.direction + 0.5 * beam.growth.across,
                                  corner.xyz, e1, e2) - at);
  vec4 up = 2.0 * (on_triangle(middle.origin + 0.5 * beam.start.up, middle.direction + 0.5 * beam.growth.up, corner.xyz,
                               e1, e2) - at);
  float facing = at.z < 0.0 ? -1.0 : 1.0;
  return SquareTriangle(Sides(facing * vec3(at.xy, at.z - at.x - at.y),
                              facing * vec3(right.xy, right.z - right.x - right.y),
                              facing * vec3(up.xy, up.z - up.x - up.y)),
                        vec3(at.w, right.w, up.w), floatBitsToUint(last.w), floatBitsToUint(corner.w), at.z >= 0.0);
}

// Whether it may show: not all of the square is beyond one of its sides, behind the eye, or beyond `far`.
bool may_show(SquareTriangle seen, float far) {
  vec3 most = seen.sides.middle + 0.5 * (abs(seen.sides.right) + abs(seen.sides.up));
  float nearest = seen.nearness.x + 0.5 * (abs(seen.nearness.y) + abs(seen.nearness.z));
  return most.x > 0.0 && most.y > 0.0 && most.z > 0.0 && nearest * far > 1.0 &&
         (seen.front || (seen.flags & kBvhCulled) == 0u);
}

vec3 triangle_normal(uint triangle, bool front) {
  int texel = int(triangle * kBvhTriangleTexels);
  vec3 normal = normalize(cross(texelFetch(bvh_triangles, texel + 1).xyz, texelFetch(bvh_triangles, texel + 2).xyz));
  return front ? normal : -normal;
}

void add_triangle(inout SquareFaces faces, uint triangle, SquareTriangle seen) {
  SquareFace face;
  face.nearness = seen.nearness;
  face.material = seen.material;
  face.normal = triangle_normal(triangle, seen.front);
  float farthest = seen.nearness.x - 0.5 * (abs(seen.nearness.y) + abs(seen.nearness.z));
  face.reach = farthest > 1.0 / kFarthest ? 1.0 / farthest : kFarthest;
  face.points = points_within(seen.sides);
  hide_behind(faces.a, face.points, face.nearness);
  hide_behind(faces.b, face.points, face.nearness);
  hide_behind(faces.c, face.points, face.nearness);
  hide_behind(faces.d, face.points, face.nearness);
  bool undecided = farthest <= 0.0 || (seen.flags & (kBvhBlends | kBvhCutOut)) != 0u;
  faces.unknown = faces.unknown || (undecided && has_points(face.points));
  join(faces.a, face);
  join(faces.b, face);
  join(faces.c, face);
  join(faces.d, face);
  settle(faces.a, face);
  settle(faces.b, face);
  settle(faces.c, face);
  settle(faces.d, face);
  faces.unknown = faces.unknown || has_points(face.points);
}

float reach_of(SquareFace face) { return has_points(face.points) ? face.reach : 0.0; }

uvec4 points_of_all(SquareFaces faces) { return faces.a.points | faces.b.points | faces.c.points | faces.d.points; }

// How far away anything is that may still show.
float reach_of_all(SquareFaces faces) {
  if (has_points(~points_of_all(faces))) {
    return kFarthest;
  }
  return max(max(reach_of(faces.a), reach_of(faces.b)), max(reach_of(faces.c), reach_of(faces.d)));
}

// How many triangles wait to be added: those of two leaves at least.
const int kMostWaiting = 32;

// Nodes and triangles that a square is worth; where there are more, rays tell. Mesa's software device ends all loops of a
// workgroup after 65,535 turns, whoever is not done; beyond 640 crowded squares of wide pictures met that end, and what
// they showed hung on the pixels beside them on the list.
const int kMostSquareSteps = 512;

// All that shows in the beam up to `far`. Triangles are found first and added later, all invocations together: on a
// software device what one of them does costs as much as when all do it.
SquareFaces square_faces(SceneRay middle, Beam beam, float far) {
  SquareFace none = SquareFace(uvec4(0u), vec3(0.0), vec3(0.0), 0u, 0.0);
  SquareFaces faces = SquareFaces(none, none, none, none, false);
  BeamReach reach = beam_reach(middle, beam, far);
  uint stack[kBvhStackSize];
  uint waiting[kMostWaiting];
  int top = 0;
  int steps = 0;
  faces.unknown = !is_sound(middle.origin, middle.direction);
  uint current = faces.unknown ? kTraversalDone : 0u;
  while (current != kTraversalDone) {
    int count = 0;
    while (current != kTraversalDone && count <= kMostWaiting - int(kBvhMaxLeafTriangles)) {
      while (current < kBvhLeafBit && steps < kMostSquareSteps) {
        ++steps;
        BeamBoxes boxes = beam_boxes(current, middle, reach);
        if (boxes.entry.x != kBoxMissed) stack[top++] = boxes.child.x;
        if (boxes.entry.y != kBoxMissed) stack[top++] = boxes.child.y;
        if (boxes.entry.z != kBoxMissed) stack[top++] = boxes.child.z;
        if (boxes.entry.w != kBoxMissed) stack[top++] = boxes.child.w;
        current = top > 0 ? stack[--top] : kTraversalDone;
      }
      while (current >= kBvhLeafBit && current != kTraversalDone &&
             count <= kMostWaiting - int(kBvhMaxLeafTriangles)) {
        uint first = (current >> kBvhLeafFirstShift) & kBvhLeafFirstMask;
        uint triangles = current & kBvhLeafCountMask;
        for (uint i = 0u; i < triangles; ++i) {
          waiting[count] = first + i;
          count += may_show(triangle_in_square(first + i, middle, beam), reach.far) ? 1 : 0;
        }
        steps += int(triangles);
        current = top > 0 ? stack[--top] : kTraversalDone;
      }
      faces.unknown = faces.unknown || steps >= kMostSquareSteps;
      current = faces.unknown ? kTraversalDone : current;
    }
    for (int i = 0; i < count; ++i) {
      add_triangle(faces, waiting[i], triangle_in_square(waiting[i], middle, beam));
    }
    reach.far = min(reach.far, reach_of_all(faces));
    current = faces.unknown ? kTraversalDone : current;
  }
  return faces;
}
