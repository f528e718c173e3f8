// glTF's metallic-roughness model (glTF 2.0, appendix B): GGX with height-correlated Smith masking (Walter 2007, Heitz
// 2014) and Schlick's Fresnel term, above a diffuse base that gets what the specular part leaves. What single
// scattering loses on rough surfaces is given back (Turquin 2019), so that a white surface in white light stays white.

struct Brdf {
  vec3 f0;
  vec3 diffuse;     // albedo
  vec3 specular;    // albedo under even light
  vec3 gain;        // of a specular lobe, for multiple scattering
  float alpha2;     // of GGX
  float roughness;
};

// The share of even light that a surface of F0 sends to the eye is f0 * x + y: Karis's fit (Physically based shading on
// mobile, 2014).
vec2 specular_share(float roughness, float n_v) {
  vec4 r = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
  float a = min(r.x * r.x, exp2(-9.28 * n_v)) * r.x + r.y;
  return vec2(-1.04, 1.04) * a + r.zw;
}

Brdf make_brdf(vec3 base, float metallic, float roughness, float n_v) {
  Brdf brdf;
  // Below, a highlight of a point light is smaller than a pixel and only glitters.
  brdf.roughness = clamp(roughness, 0.05, 1.0);
  float alpha = brdf.roughness * brdf.roughness;
  brdf.alpha2 = alpha * alpha;
  brdf.f0 = mix(vec3(0.04), base, metallic);
  vec2 share = clamp(specular_share(brdf.roughness, n_v), vec2(0.0), vec2(1.0));
  float all = clamp(share.x + share.y, 0.05, 1.0);
  brdf.gain = 1.0 + brdf.f0 * (1.0 / all - 1.0);
  brdf.specular = min((brdf.f0 * share.x + share.y) * brdf.gain, vec3(1.0));
  // A dielectric's own share, which is grey.
  float kept = 1.0 - min((0.04 * share.x + share.y) * (1.0 + 0.04 * (1.0 / all - 1.0)), 1.0);
  brdf.diffuse = base * (1.0 - metallic) * kept;
  return brdf;
}

// Times the cosine at the surface: radiance for one unit of arriving irradiance across the light.
vec3 reflected(Brdf brdf, vec3 normal, vec3 view, vec3 towards) {
  const float pi = 3.14159265358979;
  vec3 sum = view + towards;
  vec3 half_way = sum * inversesqrt(max(dot(sum, sum), 1e-12));
  float n_l = clamp(dot(normal, towards), 0.0, 1.0);
  float n_v = clamp(dot(normal, view), 1e-4, 1.0);
  float n_h = clamp(dot(normal, half_way), 0.0, 1.0);
  float v_h = clamp(dot(view, half_way), 0.0, 1.0);
  float a2 = brdf.alpha2;
  float d = n_h * n_h * (a2 - 1.0) + 1.0;
  float ggx = a2 / (pi * d * d);
  float masking = 0.5 / max(n_l * sqrt(n_v * n_v * (1.0 - a2) + a2) + n_v * sqrt(n_l * n_l * (1.0 - a2) + a2), 1e-6);
  vec3 fresnel = brdf.f0 + (1.0 - brdf.f0) * pow(1.0 - v_h, 5.0);
  return n_l * (brdf.diffuse / pi + brdf.gain * fresnel * (ggx * masking));
}
