// The rays of a tile of 8 x 8 pixels as cubics through those of its 4 x 4 corners (corners.comp.glsl, a corner every
// 8/3 pixels): each of a subgroup's 8 invocations fetches two corners, takes the others from its fellows, and has the
// cubics along its own column of pixels. The includer declares samplerBuffer corners and enables subgroup shuffles.

const int kCornersApart = 3;  // from a tile's first corner to the next one's

// A polynomial of the place along the column: 0 at the tile's upper edge, 3 at its lower one.
struct ColumnCubic {
  vec4 c0, c1, c2, c3;
};

float row_place(int row) { return (float(row) + 0.5) * (float(kCornersApart) / 8.0); }

vec4 at_place(ColumnCubic cubic, float t) { return cubic.c0 + t * (cubic.c1 + t * (cubic.c2 + t * cubic.c3)); }

// Lagrange's weights of the corners at 0, 1, 2 and 3.
vec4 corner_weights(float t) {
  float a = t - 1.0, b = t - 2.0, c = t - 3.0;
  return vec4(a * b * c * (-1.0 / 6.0), t * b * c * 0.5, t * a * c * -0.5, t * a * b * (1.0 / 6.0));
}

vec4 of_invocation(vec4 v, uint j) {
  return vec4(subgroupShuffle(v.x, j), subgroupShuffle(v.y, j), subgroupShuffle(v.z, j), subgroupShuffle(v.w, j));
}

vec4 across(vec4 weights, vec4 corner, uint first) {
  return weights.x * of_invocation(corner, first) + weights.y * of_invocation(corner, first + 1u) +
         weights.z * of_invocation(corner, first + 2u) + weights.w * of_invocation(corner, first + 3u);
}

// upper, lower: of the invocation's corners in the tile's first two rows of corners and in its last two.
ColumnCubic column_cubic(vec4 weights, vec4 upper, vec4 lower) {
  vec4 p0 = across(weights, upper, 0u);
  vec4 p1 = across(weights, upper, 4u);
  vec4 p2 = across(weights, lower, 0u);
  vec4 p3 = across(weights, lower, 4u);
  vec4 d1 = p1 - p0;
  vec4 d2 = p2 - 2.0 * p1 + p0;
  vec4 d3 = p3 - 3.0 * (p2 - p1) - p0;
  ColumnCubic cubic;
  cubic.c0 = p0;
  cubic.c1 = d1 - 0.5 * d2 + (1.0 / 3.0) * d3;
  cubic.c2 = 0.5 * (d2 - d3);
  cubic.c3 = (1.0 / 6.0) * d3;
  return cubic;
}

// What an invocation knows of a tile before it fetches parts of corners.
struct TileCorners {
  int upper, lower;  // texels of its two corners
  vec4 weights;
};

TileCorners tile_corners(ivec2 tile) {
  int lane = int(gl_SubgroupInvocationID);
  ivec2 count = ivec2(frame.corners.zw);
  ivec2 corner = kCornersApart * tile + ivec2(lane & 3, lane >> 2);
  TileCorners c;
  c.upper = kCornerTexels * ((frame.view.x * count.y + corner.y) * count.x + corner.x);
  c.lower = c.upper + kCornerTexels * 2 * count.x;
  c.weights = corner_weights(row_place(lane));
  return c;
}

// Where a column's rays leave for the scene and which way they go, in the world's axes; directions are not of unit length.
struct ColumnRays {
  ColumnCubic origin;
  ColumnCubic direction;
};

// world: the columns of world_from_eye, its translation in their w.
ColumnRays column_rays(TileCorners c, vec4 world_x, vec4 world_y, vec4 world_z) {
  mat3 turn = mat3(world_x.xyz, world_y.xyz, world_z.xyz);
  vec3 shift = vec3(world_x.w, world_y.w, world_z.w);
  vec4 upper_origin = vec4(turn * texelFetch(corners, c.upper).xyz + shift, 0.0);
  vec4 lower_origin = vec4(turn * texelFetch(corners, c.lower).xyz + shift, 0.0);
  vec4 upper_direction = vec4(turn * texelFetch(corners, c.upper + 1).xyz, 0.0);
  vec4 lower_direction = vec4(turn * texelFetch(corners, c.lower + 1).xyz, 0.0);
  return ColumnRays(column_cubic(c.weights, upper_origin, lower_origin),
                    column_cubic(c.weights, upper_direction, lower_direction));
}

vec3 cubic_origin(ColumnRays rays, int row) { return at_place(rays.origin, row_place(row)).xyz; }

// Of unit length.
vec3 cubic_direction(ColumnRays rays, int row) { return normalize(at_place(rays.direction, row_place(row)).xyz); }

bool tile_is_smooth(usamplerBuffer words, ivec2 tile) {
  int across = (frame.size.x + 7) / 8;
  return texelFetch(words, frame.view.x * frame.sampling.y + tile.y * across + tile.x).x != 0u;
}
