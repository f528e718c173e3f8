// glTF's metallic-roughness model (glTF 2.0, appendix B): GGX with height-correlated Smith masking (Walter 2007, Heitz
// 2014) and Schlick's Fresnel term, above a diffuse base that gets what the specular part leaves. What single
// scattering loses on rough surfaces is given back (Turquin 2019), so that a white surface in white light stays white.

// A blend of a metal and a dielectric, as one lobe whose Fresnel term is base + rise * (1 - cos)^5.
struct Brdf {
  vec3 diffuse;     // albedo
  vec3 specular;    // albedo under even light
  vec3 base;
  vec3 rise;
  float alpha2;     // of GGX
  float roughness;
};

// What a GGX lobe sends back of even light: for a Fresnel term of 1, and for one of (1 - cos)^5. Polynomials in 1 - cos
// of the view and in roughness, fitted to the integrals; good to 0.01 rms.
vec2 lobe_share(float roughness, float n_v) {
  vec4 powers = vec4(1.0, roughness, roughness * roughness, roughness * roughness * roughness);
  float u = 1.0 - n_v;
  float u2 = u * u;
  float u5 = u2 * u2 * u;
  vec4 all = vec4(
      dot(vec4(0.9561, 0.6101, -1.6446, 0.3556), powers),
      dot(vec4(-0.1277, 1.3122, -3.5241, 2.6402), powers),
      dot(vec4(0.3936, -3.7731, 7.5615, -4.1238), powers),
      dot(vec4(-0.2044, 0.7588, 0.2637, -0.5441), powers));
  vec4 rise = vec4(
      dot(vec4(0.0029, -0.0194, 0.0297, -0.0129), powers),
      dot(vec4(-0.0791, 0.5970, -0.7699, 0.2500), powers),
      dot(vec4(1.3071, -1.1082, -3.4392, 3.3719), powers),
      dot(vec4(-0.0207, -3.3695, 8.7876, -5.4929), powers));
  return vec2(clamp(dot(all, vec4(1.0, u, u2, u5)), 0.3, 1.0),
              clamp(dot(rise, vec4(1.0, u2, u5, u5 * u2 * u2)), 0.0, 1.0));
}

Brdf make_brdf(vec3 colour, float metallic, float roughness, float n_v) {
  Brdf brdf;
  // Below, a highlight of a point light is smaller than a pixel and only glitters.
  brdf.roughness = clamp(roughness, 0.05, 1.0);
  float alpha = brdf.roughness * brdf.roughness;
  brdf.alpha2 = alpha * alpha;
  vec2 share = lobe_share(brdf.roughness, n_v);
  float lost = 1.0 / share.x - 1.0;
  const float f0 = 0.04;
  float grey_gain = 1.0 + f0 * lost;
  float grey = min(grey_gain * (f0 * share.x + (1.0 - f0) * share.y), 1.0);
  vec3 metal_gain = metallic * (1.0 + colour * lost);
  brdf.base = metal_gain * colour + (1.0 - metallic) * grey_gain * f0;
  brdf.rise = metal_gain * (1.0 - colour) + (1.0 - metallic) * grey_gain * (1.0 - f0);
  brdf.specular = brdf.base * share.x + brdf.rise * share.y;
  brdf.diffuse = colour * (1.0 - metallic) * (1.0 - grey);
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
  float off = 1.0 - v_h;
  float off2 = off * off;
  return n_l * (brdf.diffuse / pi + (brdf.base + brdf.rise * (off2 * off2 * off)) * (ggx * masking));
}
