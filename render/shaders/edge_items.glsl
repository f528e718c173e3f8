// What an edge's pixel says of itself on the lists, beside its place (and kListThin of frame.h).
const uint kListShared = 0x40000000u;  // its faces' parts are known: it has shares
const uint kListLit = 0x20000000u;     // doubtful: its light changes on one face

// Shares, in place of a pixel's key: up to four rays, 16 bits each, how many of the square's 128 points count by this ray
// and, above that, the point that it takes (faces.glsl). The others count by the middle ray.
const int kMostShares = 4;
const uint kSharePartBits = 8u;
