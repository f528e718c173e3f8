// Whether two pixels lie on two sides of an edge. The including shader declares pixels, keys and frame.

// The place of a pixel's block in the list of blocks.
int block_index(ivec2 p) {
  return p.y / kBeamBlock * ((frame.size.x + kBeamBlock - 1) / kBeamBlock) + p.x / kBeamBlock;
}

// Another material, status, slope or depth.
bool differs_in_shape(uvec2 key, float depth, int at) {
  uvec2 other = texelFetch(keys, at).xy;
  uint change = other.x ^ key.x;
  if ((change & 0xffffu) != 0u) {
    return true;
  }
  if (change != 0u) {
    ivec3 a = ivec3((uvec3(key.x) >> uvec3(16u, 21u, 26u)) & 31u);
    ivec3 b = ivec3((uvec3(other.x) >> uvec3(16u, 21u, 26u)) & 31u);
    ivec3 d = abs(a - b);
    if (d.x + d.y + d.z > 6) {
      return true;
    }
  }
  float other_depth = uintBitsToFloat(texelFetch(pixels, at).w);
  return abs(other_depth - depth) > 0.05 * max(max(depth, other_depth), 0.0);
}

// Beside the lens, or through its rim.
bool differs_in_status(uvec2 key, int at) { return ((texelFetch(keys, at).x ^ key.x) & 0xf000u) != 0u; }

// Shadows and textures have edges too: a jump of more than an eighth.
bool differs_in_light(uvec2 key, int at) {
  float luminance = uintBitsToFloat(key.y);
  float other = uintBitsToFloat(texelFetch(keys, at).y);
  return abs(other - luminance) > 0.125 * max(luminance, other) + 0.002;
}
