// Which part of the picture a workgroup takes. A software device gives each of its threads one run of workgroups and
// waits for the slowest, and a picture's halves seldom cost the same: so rows are dealt out in turn, as many at a time
// as there are threads (frame.view.z; 1 leaves the order alone).

#ifdef SHOWN_TILES_AT  // a kernel that goes through the picture by tiles of 8 x 8 pixels; its binding for their list
layout(constant_id = 10) const uint kListedTiles = 0u;  // 1: where only some are drawn (render/shown_tiles.hpp)
layout(binding = SHOWN_TILES_AT) uniform usamplerBuffer shown_tiles;

// The tile at a place of the view's list; one beyond the picture where the list has ended.
uvec2 shown_tile(uint place) {
  uint tile = texelFetch(shown_tiles, frame.view.x * frame.sampling.y + int(place)).x;
  return uvec2(tile & 0xffffu, tile >> 16);
}

uint group_index() { return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x; }
#else
const uint kListedTiles = 0u;
uint group_index() { return 0u; }
uvec2 shown_tile(uint place) { return uvec2(place); }
#endif

uvec2 group_in_picture() {
  if (kListedTiles != 0u) {
    return shown_tile(group_index());
  }
  float hands = float(max(frame.view.z, 1));
  float rows = float(gl_NumWorkGroups.y);
  float y = float(gl_WorkGroupID.y);
  // Floats, whose quotients of whole numbers below 2^22 are safe by the half: integer division has no vector form.
  float longest = floor((rows + hands - 0.5) / hands);  // rows of the first `full` threads, one more than of the others
  float full = rows - hands * (longest - 1.0);
  float beyond = max(y - full * longest, 0.0);
  bool is_full = y < full * longest;
  float length = is_full ? longest : longest - 1.0;
  float hand = floor(((is_full ? y : beyond) + 0.5) / max(length, 1.0));
  float turn = (is_full ? y : beyond) - hand * length;
  return uvec2(gl_WorkGroupID.x, uint(turn * hands + hand + (is_full ? 0.0 : full)));
}

// The pixel of an invocation of a group of 8 x 8.
ivec2 pixel_in_picture() { return ivec2(group_in_picture() * 8u + gl_LocalInvocationID.xy); }

// The same where all pixels cost alike, so that the device's own order does.
uvec2 group_in_order() { return kListedTiles != 0u ? group_in_picture() : gl_WorkGroupID.xy; }
ivec2 pixel_in_order() { return ivec2(group_in_order() * 8u + gl_LocalInvocationID.xy); }
