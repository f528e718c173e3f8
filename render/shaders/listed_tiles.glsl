// Tiles in a list (frame.h). The includer declares `list`, a texel buffer: its words are loaded once for all invocations
// of a software device. A workgroup takes what its own index says: around a loop over the list, a software device spills
// what the loops within need.
uint listed_place() { return gl_WorkGroupID.y * kListAcross + gl_WorkGroupID.x; }

bool is_listed(uint place) { return place < texelFetch(list, int(kListCountAt)).x; }

ivec2 listed_tile(uint place) {
  uint item = texelFetch(list, int(kListFirstAt + place)).x;
  return ivec2(item & 0xffffu, item >> 16);
}

// The invocation's pixel of the workgroup's tile; beyond the picture where the list has ended.
ivec2 listed_pixel() {
  uint place = listed_place();
  ivec2 p = kBlurTile * listed_tile(place) + ivec2(gl_LocalInvocationID.xy);
  return is_listed(place) ? p : frame.size.xy;
}
