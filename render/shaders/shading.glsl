// What a ray sees: a matte surface under the scene's lights with shadow rays, or the sky. Linear, unclamped radiance.

vec3 sky_radiance(vec3 direction) {
  float height = clamp(direction.y, 0.0, 1.0);
  return mix(environment.sky_horizon.rgb, environment.sky_zenith.rgb, sqrt(height));
}

vec3 rgb9e5(uint packed) {
  float scale = exp2(float(packed >> 27) - 24.0);
  return vec3(float(packed & 511u), float((packed >> 9) & 511u), float((packed >> 18) & 511u)) * scale;
}

// i: a whole number below 1e7, so that floats are exact but for the quotient, whose rounding the clamp catches. Integer
// division has no vector form on CPUs.
int wrapped(float i, float n, int mode) {
  float period = mode == 2 ? 2.0 * n : n;
  float j = i - period * floor(i / period);
  j = mode == 2 && j >= n ? period - 1.0 - j : j;
  return int(clamp(mode == 1 ? i : j, 0.0, n - 1.0));
}

vec3 sample_texture(int index, vec2 uv) {
  ivec4 t = texture_data(index).size;
  vec2 p = uv * vec2(float(t.y), float(t.z)) - 0.5;
  vec2 corner = floor(p);
  vec2 w = p - corner;
  vec2 low = clamp(corner, vec2(-1e7), vec2(1e7));
  vec2 size = vec2(t.yz);
  int x0 = wrapped(low.x, size.x, t.w & 255);
  int x1 = wrapped(low.x + 1.0, size.x, t.w & 255);
  int y0 = wrapped(low.y, size.y, t.w >> 8);
  int y1 = wrapped(low.y + 1.0, size.y, t.w >> 8);
  vec3 top = mix(rgb9e5(texelFetch(texels, t.x + y0 * t.y + x0).x), rgb9e5(texelFetch(texels, t.x + y0 * t.y + x1).x), w.x);
  vec3 bottom =
      mix(rgb9e5(texelFetch(texels, t.x + y1 * t.y + x0).x), rgb9e5(texelFetch(texels, t.x + y1 * t.y + x1).x), w.x);
  return mix(top, bottom, w.y);
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
  vec3 normal;  // facing the ray
};

Surface shade_hit(Hit hit, vec3 origin, vec3 direction) {
  MaterialData material = material_data(hit.material);
  int at = int(hit.triangle * kBvhShadingTexels);
  vec4 a = texelFetch(shading_triangles, at);
  vec4 b = texelFetch(shading_triangles, at + 1);
  vec4 c = texelFetch(shading_triangles, at + 2);
  vec4 v = texelFetch(shading_triangles, at + 3);
  float w = 1.0 - hit.u - hit.v;
  vec2 uv = vec2(w * a.w + hit.u * b.w + hit.v * c.w, w * v.x + hit.u * v.y + hit.v * v.z);
  int triangle = int(hit.triangle * kBvhTriangleTexels);
  vec3 face = normalize(cross(texelFetch(bvh_triangles, triangle + 1).xyz, texelFetch(bvh_triangles, triangle + 2).xyz));
  vec3 normal = normalize(w * a.xyz + hit.u * b.xyz + hit.v * c.xyz);
  float side = dot(face, direction) > 0.0 ? -1.0 : 1.0;
  face *= side;
  normal *= dot(normal, face) < 0.0 ? -1.0 : 1.0;
  vec3 base = material.base_colour.rgb;
  if (material.textures.x >= 0) {
    base *= sample_texture(material.textures.x, uv);
  }
  vec3 emission = material.emission.rgb;
  if (material.textures.y >= 0) {
    emission *= sample_texture(material.textures.y, uv);
  }
  vec3 p = origin + hit.t * direction;
  // Off the surface by more than the rounding of p, which grows with the coordinates.
  vec3 lifted = p + face * (1e-5 + 2e-6 * max(max(abs(p.x), abs(p.y)), abs(p.z)));
  vec3 light = environment.ambient.rgb;
  for (int i = 0; i < environment.counts.x; ++i) {
    vec3 towards;
    float reach;
    vec3 arriving = light_at(light_data(i), lifted, towards, reach) * max(dot(normal, towards), 0.0);
    if (max(max(arriving.r, arriving.g), arriving.b) > 0.0 && dot(face, towards) > 0.0 &&
        (kShadows == 0u || !trace_any(lifted, towards, reach * 0.9999))) {
      light += arriving * (1.0 / 3.14159265358979);
    }
  }
  Surface surface;
  surface.radiance = base * light + emission;
  surface.normal = face;
  return surface;
}
