// What a ray sees: a surface under the scene's lights with shadow rays and under an even light from everywhere, or the
// sky. Linear, unclamped radiance. A dielectric of roughness 1 is taken as matte: its sheen is below 4 %.

#include "render/shaders/brdf.glsl"

vec3 sky_radiance(vec3 direction) {
  float height = clamp(direction.y, 0.0, 1.0);
  return mix(environment.sky_horizon.rgb, environment.sky_zenith.rgb, sqrt(height));
}

// The part of a light that reaches a point, with its direction: irradiance per unit cosine.
vec3 light_at(LightData light, vec3 p, out vec3 towards, out float reach) {
  int type = int(light.colour.w);
  if (type == kLightDirectional) {
    towards = -light.direction.xyz;
    reach = 1e30;
    return light.colour.rgb;
  }
  vec3 offset = light.position.xyz - p;
  float distance2 = max(dot(offset, offset), 1e-8);
  reach = sqrt(distance2);
  towards = offset / reach;
  float fade = 1.0 / distance2;
  if (light.position.w > 0.0) {
    // KHR_lights_punctual's recommended window.
    float q = distance2 / (light.position.w * light.position.w);
    fade *= clamp(1.0 - q * q, 0.0, 1.0);
  }
  if (type == kLightSpot) {
    float edge = clamp((dot(light.direction.xyz, -towards) - light.cone.y) / max(light.cone.x - light.cone.y, 1e-4), 0.0, 1.0);
    fade *= edge * edge;
  }
  return light.colour.rgb * fade;
}

struct Surface {
  vec3 radiance;
  vec3 normal;  // the face's, towards the ray
  float alpha;
};

// How far a pixel's beam moves across the ray from one pixel to the next, m, world.
struct Footprint {
  vec3 across;
  vec3 up;
};

// Off a point of a surface by more than the rounding of its coordinates.
float lift(vec3 p) { return 1e-5 + 2e-6 * max(max(abs(p.x), abs(p.y)), abs(p.z)); }

// What comes through from a light: nothing behind what is solid, dimmed behind what blends.
float light_through(vec3 origin, vec3 towards, float reach) {
  ray_kind = kRayBlocked;
  float through = trace_any(origin, towards, reach) ? 0.0 : 1.0;
  if (HAS(kFeatureBlend)) {
    ray_kind = kRayDimmed;
    Hit hit;
    for (int layer = 0; layer < kMostLayers; ++layer) {
      if (!(through > 1.0 / 512.0) || !(reach > 0.0) || !trace_closest(origin, towards, reach, hit)) {
        break;
      }
      through *= 1.0 - hit_alpha(hit.triangle, hit.material, hit.u, hit.v);
      float on = hit.t + lift(origin + hit.t * towards);
      origin += on * towards;
      reach -= on;
    }
  }
  ray_kind = kRaySees;
  return through;
}

// Texture coordinates at a hit and along the triangle's two edges, and the footprint in barycentric weights.
struct HitUv {
  vec2 at[2], edge1[2], edge2[2];  // of both sets
  vec2 across, up;
};

struct SlotUv {
  vec2 at, edge1, edge2;
  UvFootprint footprint;
};

SlotUv slot_uv(HitUv uv, int slot, uint material) {
  int set = on_second_uv(material, slot) ? 1 : 0;
  vec2 corner = set == 1 ? uv.at[1] : uv.at[0];
  vec2 edge1 = set == 1 ? uv.edge1[1] : uv.edge1[0];
  vec2 edge2 = set == 1 ? uv.edge2[1] : uv.edge2[0];
  SlotUv result;
  result.at = transformed(corner, slot, material);
  vec2 origin = transformed(vec2(0.0), slot, material);
  result.edge1 = transformed(edge1, slot, material) - origin;
  result.edge2 = transformed(edge2, slot, material) - origin;
  result.footprint.across = uv.across.x * result.edge1 + uv.across.y * result.edge2;
  result.footprint.up = uv.up.x * result.edge1 + uv.up.y * result.edge2;
  return result;
}

vec3 slot_texture(HitUv uv, int slot, uint material, int index, int format) {
  SlotUv at = slot_uv(uv, slot, material);
  return sample_texture(index, at.at, at.footprint, format);
}

// The footprint follows the ray on to the face; its shift in barycentric weights of corners 1 and 2.
vec2 shift_on_face(vec3 across, vec3 direction, vec3 e1, vec3 e2) {
  vec3 n = cross(e1, e2);
  float slope = dot(direction, n);
  float least = 1e-3 * length(n);
  slope = slope < 0.0 ? min(slope, -least) : max(slope, least);
  vec3 on_face = across - direction * (dot(across, n) / slope);
  return vec2(dot(cross(on_face, e2), n), dot(cross(e1, on_face), n)) / dot(n, n);
}

// The tangent frame comes from the coordinates themselves, whether or not the file brings tangents. Green points
// against v, up in the image (glTF 2.0, section 3.9.3).
vec3 mapped_normal(vec3 normal, SlotUv uv, vec3 e1, vec3 e2, vec3 texel, float scale) {
  float det = uv.edge1.x * uv.edge2.y - uv.edge1.y * uv.edge2.x;
  vec3 along_u = (e1 * uv.edge2.y - e2 * uv.edge1.y) * sign(det);
  vec3 against_v = (e1 * uv.edge2.x - e2 * uv.edge1.x) * sign(det);
  vec3 tangent = along_u - dot(along_u, normal) * normal;
  float size2 = dot(tangent, tangent);
  if (!(size2 > 0.0)) {
    return normal;
  }
  tangent *= inversesqrt(size2);
  vec3 bitangent = cross(normal, tangent);
  bitangent *= dot(bitangent, against_v) < 0.0 ? -1.0 : 1.0;
  vec3 n = (2.0 * texel - 1.0) * vec3(scale, scale, 1.0);
  vec3 sum = n.x * tangent + n.y * bitangent + max(n.z, 0.01) * normal;
  return normalize(sum);
}

Surface shade_hit(Hit hit, vec3 origin, vec3 direction, Footprint footprint) {
  ivec4 flags = material_indices(hit.material, kMaterialFlagsAt);
  Corners k = corners_of(hit.triangle);
  float w = 1.0 - hit.u - hit.v;
  int triangle = int(hit.triangle * kBvhTriangleTexels);
  vec3 e1 = texelFetch(bvh_triangles, triangle + 1).xyz;
  vec3 e2 = texelFetch(bvh_triangles, triangle + 2).xyz;
  vec3 face = normalize(cross(e1, e2));
  vec3 normal = normalize(w * k.a.xyz + hit.u * k.b.xyz + hit.v * k.c.xyz);
  vec4 base = material_part(hit.material, kMaterialBaseColourAt);
  vec3 emission = material_part(hit.material, kMaterialEmissionAt).rgb;
  float metallic = 0.0;
  float roughness = 1.0;
  if (HAS(kFeatureShiny)) {
    vec2 factors = material_part(hit.material, kMaterialSurfaceAt).xy;
    metallic = factors.x;
    roughness = factors.y;
  }
  float open = 1.0;  // to the light from everywhere
  ivec4 maps = ivec4(-1);
  HitUv uv;
  if (HAS(kFeatureTexture)) {
    maps = material_indices(hit.material, kMaterialTexturesAt);
    uv.edge1[0] = vec2(k.b.w - k.a.w, k.v.y - k.v.x);
    uv.edge2[0] = vec2(k.c.w - k.a.w, k.v.z - k.v.x);
    uv.at[0] = vec2(w * k.a.w + hit.u * k.b.w + hit.v * k.c.w, w * k.v.x + hit.u * k.v.y + hit.v * k.v.z);
    uv.across = shift_on_face(footprint.across, direction, e1, e2);
    uv.up = shift_on_face(footprint.up, direction, e1, e2);
  }
  if (HAS(kFeatureSecondUv | kFeatureColours)) {
    MoreCorners more = more_corners_of(hit.triangle);
    uv.edge1[1] = more.uv[1] - more.uv[0];
    uv.edge2[1] = more.uv[2] - more.uv[0];
    uv.at[1] = w * more.uv[0] + hit.u * more.uv[1] + hit.v * more.uv[2];
    base *= w * more.colour[0] + hit.u * more.colour[1] + hit.v * more.colour[2];
  }
  if (HAS(kFeatureTexture)) {
    if (maps.x >= 0) {
      base.rgb *= slot_texture(uv, kSlotBaseColour, hit.material, maps.x, kTexelColour);
    }
  }
  if (HAS(kFeatureEmission)) {
    if (maps.y >= 0) {
      emission *= slot_texture(uv, kSlotEmission, hit.material, maps.y, kTexelColour);
    }
  }
  if (HAS(kFeatureBlend)) {
    if (flags.z >= 0) {
      base.a *= slot_texture(uv, kSlotBaseColour, hit.material, flags.z, kTexelAlpha).x;
    }
  }
  if (HAS(kFeatureMaps)) {
    if (maps.z >= 0) {
      vec3 texel = slot_texture(uv, kSlotSurface, hit.material, maps.z, kTexelData);
      roughness *= texel.g;
      metallic *= texel.b;
    }
    if (flags.w >= 0) {
      float texel = slot_texture(uv, kSlotOcclusion, hit.material, flags.w, kTexelData).r;
      open = 1.0 + material_part(hit.material, kMaterialMapsAt).y * (texel - 1.0);
    }
    if (maps.w >= 0) {
      SlotUv at = slot_uv(uv, kSlotNormal, hit.material);
      vec3 texel = sample_texture(maps.w, at.at, at.footprint, kTexelData);
      normal = mapped_normal(normal, at, e1, e2, texel, material_part(hit.material, kMaterialMapsAt).x);
    }
  }
  float side = dot(face, direction) > 0.0 ? -1.0 : 1.0;
  face *= side;
  normal *= dot(normal, face) < 0.0 ? -1.0 : 1.0;
  Surface surface;
  surface.normal = face;
  surface.alpha = HAS(kFeatureBlend) && (flags.x & kMaterialBlends) != 0 ? clamp(base.a, 0.0, 1.0) : 1.0;
  if (HAS(kFeatureUnlit)) {
    if ((flags.x & kMaterialUnlit) != 0) {
      surface.radiance = base.rgb;
      return surface;
    }
  }
  bool matte = !HAS(kFeatureShiny) || (flags.x & kMaterialMatte) != 0;
  vec3 p = origin + hit.t * direction;
  vec3 lifted = p + face * lift(p);
  Brdf brdf;
  if (HAS(kFeatureShiny)) {
    brdf = make_brdf(base.rgb, metallic, roughness, clamp(dot(normal, -direction), 1e-4, 1.0));
  }
  vec3 light = environment.ambient.rgb * open;  // on a matte surface
  vec3 shine = environment.ambient.rgb * open * (brdf.diffuse + brdf.specular);
  // After the lights a smooth surface looks along the mirrored ray for the sky.
  // Nor does a number from a uniform buffer end the loop (EnvironmentData). A scene without lights has one.
  int light_count = kBare != 0u ? 1 : textureSize(lights) / 4;
  int rays = light_count + (matte ? 0 : 1);
  for (int i = 0; i < rays; ++i) {
    bool mirrored = HAS(kFeatureShiny) && i == light_count;
    vec3 towards;
    float reach = 1e30;
    vec3 arriving;
    if (mirrored) {
      towards = reflect(direction, normal);
      arriving = open * (1.0 - brdf.roughness) * brdf.specular * (sky_radiance(towards) - environment.ambient.rgb);
    } else {
      LightData light_here = environment.first_light[frame.view.w];
      if (kBare == 0u) {
        light_here = light_data(i);
      }
      arriving = light_at(light_here, lifted, towards, reach);
      arriving *= matte ? vec3(max(dot(normal, towards), 0.0)) : reflected(brdf, normal, -direction, towards);
    }
    vec3 size = abs(arriving);
    if (max(max(size.r, size.g), size.b) > 0.0 && dot(face, towards) > 0.0) {
      if (kBare == 0u) {
        arriving *= light_through(lifted, towards, reach * 0.9999);
      }
      light += arriving * (1.0 / 3.14159265358979);
      shine += arriving;
    }
  }
  surface.radiance = (matte ? base.rgb * light : shine) + emission;
  return surface;
}
