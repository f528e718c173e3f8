// Coddington's equations along a ray in the vertical plane through a centred lens of two spheres: an oracle for the
// vergence at the pupil that shares nothing with the ray-transfer matrices.
#pragma once

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace support {

struct CentredLens {
  double index, thickness, front_curvature, back_curvature;
  double pupil_to_back;  // m
};

struct TangentialSagittal {
  double tangential, sagittal;  // D, converging positive, at the pupil
};

namespace coddington {

struct Refraction {
  double cos_air, cos_glass;
};

// Meets the sphere of curvature c with its vertex at z = vertex; p and d are (y, z) and are carried on.
inline Refraction cross_surface(glm::dvec2& p, glm::dvec2& d, double& path, double vertex, double c, double n_in,
                                double n_out) {
  const glm::dvec2 o(p.x, p.y - vertex);
  const double b = c * glm::dot(o, d) - d.y;
  const double k = c * glm::dot(o, o) - 2.0 * o.y;
  path = -k / (b + std::sqrt(b * b - c * k));
  p += path * d;
  const glm::dvec2 normal = -glm::dvec2(c * p.x, c * (p.y - vertex) - 1.0);  // unit: the sphere's radius
  const glm::dvec2 facing = glm::dot(normal, d) > 0.0 ? normal : -normal;
  const double cos_in = glm::dot(facing, d);
  const double mu = n_in / n_out;
  const double cos_out = std::sqrt(1.0 - mu * mu * (1.0 - cos_in * cos_in));
  d = glm::normalize(mu * d + (cos_out - mu * cos_in) * facing);
  return n_in < n_out ? Refraction{cos_in, cos_out} : Refraction{cos_out, cos_in};
}

inline void travel(TangentialSagittal& w, double reduced) {
  w.tangential /= 1.0 - reduced * w.tangential;
  w.sagittal /= 1.0 - reduced * w.sagittal;
}

// Light passing from index n (cosine c) into n2 (cosine c2).
inline void refract(TangentialSagittal& w, double n, double c, double n2, double c2, double curvature) {
  const double bend = (n2 * c2 - n * c) * curvature;
  w.tangential = (w.tangential * c * c + bend) / (c2 * c2);
  w.sagittal += bend;
}

}  // namespace coddington

// A chief ray that leaves the pupil `elevation` above the axis; object at distance 1/q beyond the front surface.
inline TangentialSagittal coddington_vergence(const CentredLens& lens, double elevation, double q) {
  using namespace coddington;  // NOLINT(google-build-using-namespace)
  glm::dvec2 p(0.0);
  glm::dvec2 d(std::sin(elevation), -std::cos(elevation));
  double to_back = 0.0;
  double in_glass = 0.0;
  const Refraction back = cross_surface(p, d, to_back, -lens.pupil_to_back, lens.back_curvature, 1.0, lens.index);
  const Refraction front =
      cross_surface(p, d, in_glass, -lens.pupil_to_back - lens.thickness, lens.front_curvature, lens.index, 1.0);
  // Light comes the other way: front, glass, back, pupil; a centre on the eye side lies ahead.
  TangentialSagittal w{-q, -q};
  refract(w, 1.0, front.cos_air, lens.index, front.cos_glass, lens.front_curvature);
  travel(w, in_glass / lens.index);
  refract(w, lens.index, back.cos_glass, 1.0, back.cos_air, lens.back_curvature);
  travel(w, to_back);
  return w;
}

}  // namespace support
