// Where a triangle is there at all: backs of single-sided ones are not seen (glTF 2.0, section 3.9.6), holes of cut-out
// ones neither block nor show, and what blends does not stop a shadow ray but dims it (shading.glsl).

const int kRaySees = 0;    // from the eye
const int kRayBlocked = 1; // a shadow ray, all but what blends
const int kRayDimmed = 2;  // a shadow ray, only what blends
const int kRaySolid = 3;   // from the eye, through what blends
int ray_kind = kRaySees;

struct Corners {
  vec4 a, b, c, v;  // gpu/bvh_layout.h
};

Corners corners_of(uint triangle) {
  int at = int(triangle * kBvhShadingTexels);
  return Corners(texelFetch(shading_triangles, at), texelFetch(shading_triangles, at + 1),
                 texelFetch(shading_triangles, at + 2), texelFetch(shading_triangles, at + 3));
}

// The second texture coordinates and the colours of three corners, behind all triangles' own shading data.
struct MoreCorners {
  vec2 uv[3];
  vec4 colour[3];
};

MoreCorners more_corners_of(uint triangle) {
  int at = environment.counts.y + int(triangle * kBvhMoreTexels);
  vec4 p = texelFetch(shading_triangles, at);
  vec4 q = texelFetch(shading_triangles, at + 1);
  vec4 r = texelFetch(shading_triangles, at + 2);
  MoreCorners more;
  more.uv[0] = p.xy;
  more.uv[1] = p.zw;
  more.uv[2] = q.xy;
  more.colour[0] = vec4(unpackHalf2x16(floatBitsToUint(q.z)), unpackHalf2x16(floatBitsToUint(q.w)));
  more.colour[1] = vec4(unpackHalf2x16(floatBitsToUint(r.x)), unpackHalf2x16(floatBitsToUint(r.y)));
  more.colour[2] = vec4(unpackHalf2x16(floatBitsToUint(r.z)), unpackHalf2x16(floatBitsToUint(r.w)));
  return more;
}

vec2 transformed(vec2 uv, int slot, uint material) {
  if (!HAS(kFeatureTransform)) {
    return uv;
  }
  vec4 linear = material_part(material, kMaterialUvLinearAt + slot);
  vec2 offset = material_part(material, kMaterialUvOffsetAt + slot).xy;
  return vec2(linear.x * uv.x + linear.z * uv.y, linear.y * uv.x + linear.w * uv.y) + offset;
}

bool on_second_uv(uint material, int slot) {
  return HAS(kFeatureSecondUv) && ((material_indices(material, kMaterialFlagsAt).y >> slot) & 1) != 0;
}

// u, v: barycentric weights of corners 1 and 2. Alpha comes from the texture's finest level.
float hit_alpha(uint triangle, uint material, float u, float v) {
  float w = 1.0 - u - v;
  float alpha = material_part(material, kMaterialBaseColourAt).a;
  if (HAS(kFeatureSecondUv | kFeatureColours)) {
    MoreCorners more = more_corners_of(triangle);
    alpha *= w * more.colour[0].a + u * more.colour[1].a + v * more.colour[2].a;
  }
  int plane = material_indices(material, kMaterialFlagsAt).z;
  if (plane >= 0) {
    Corners k = corners_of(triangle);
    vec2 uv = vec2(w * k.a.w + u * k.b.w + v * k.c.w, w * k.v.x + u * k.v.y + v * k.v.z);
    if (on_second_uv(material, kSlotBaseColour)) {
      MoreCorners more = more_corners_of(triangle);
      uv = w * more.uv[0] + u * more.uv[1] + v * more.uv[2];
    }
    alpha *= sample_level(texture_size(plane), 0, transformed(uv, kSlotBaseColour, material), kTexelAlpha).x;
  }
  return alpha;
}

// flags: kBvhCulled and its fellows. front: the ray meets the triangle's front.
bool ray_meets(uint flags, bool front, uint triangle, uint material, float u, float v) {
  bool meets = true;
  if (HAS(kFeatureCull)) {
    meets = front || ray_kind == kRayBlocked || ray_kind == kRayDimmed || (flags & kBvhCulled) == 0u;
  }
  if (HAS(kFeatureBlend)) {
    bool blends = (flags & kBvhBlends) != 0u;
    meets = meets && (ray_kind == kRaySees || (ray_kind == kRayDimmed) == blends);
  }
  if (HAS(kFeatureMask)) {
    if (meets && (flags & kBvhCutOut) != 0u) {
      meets = hit_alpha(triangle, material, u, v) >= material_part(material, kMaterialSurfaceAt).w;
    }
  }
  return meets;
}

#define VERGENCE_MEETS(flags, front, triangle, material, u, v) ray_meets(flags, front, triangle, material, u, v)
