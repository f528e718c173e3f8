// Lenses and rays that the file format allows and no wearer has, for "every output is finite".
#pragma once

#include <array>

#include "tests/support/random_lens.hpp"

namespace support {

// Radii from a micrometre to a million kilometres, either sign, or flat.
inline double absurd_curvature(Random& random) {
  return random.chance(0.1) ? 0.0 : random.sign() / random.log_uniform(1e-6, 1e9);
}

inline lenses::Torus absurd_torus(Random& random) {
  lenses::Torus torus;
  torus.curvature_u = absurd_curvature(random);
  switch (random.pick(4)) {
    case 0:
      torus.curvature_v = torus.curvature_u;
      break;
    case 1:
      torus.curvature_v = torus.curvature_u * (1.0 + random.sign() * random.log_uniform(1e-15, 1e-2));
      break;
    case 2:
      torus.curvature_v = -torus.curvature_u;
      break;
    default:
      torus.curvature_v = absurd_curvature(random);
  }
  torus.axis = random.uniform(0.0, std::numbers::pi);
  torus.revolve = random.chance(0.5) ? lenses::Torus::Revolve::u : lenses::Torus::Revolve::v;
  return torus;
}

inline lenses::Conic absurd_conic(Random& random, double semi_diameter) {
  lenses::Conic conic;
  conic.curvature = absurd_curvature(random);
  conic.conic_constant = random.chance(0.2) ? -1.0 : random.sign() * random.log_uniform(1e-3, 1e4);
  const std::size_t terms = random.pick(9);
  double power = std::pow(semi_diameter, 4);
  const bool largest = random.chance(0.1);
  for (std::size_t i = 0; i < terms; ++i) {
    if (largest) {  // what a file may say: 1 mm^-3, 1 mm^-5, ...
      conic.even_coefficients.push_back(random.sign() * std::pow(1e3, static_cast<double>(2 * i + 3)));
      continue;
    }
    // From a nanometre to a metre of sag at the rim.
    conic.even_coefficients.push_back(random.sign() * random.log_uniform(1e-9, 1.0) / power);
    power *= semi_diameter * semi_diameter;
  }
  return conic;
}

// Waves and noise of a nanometre to a decimetre over anything from a millimetre to the whole lens.
inline lenses::BasicSurface absurd_spline(Random& random, bool parametric) {
  const double half = random.log_uniform(1e-3, 0.1);
  const double height = random.log_uniform(1e-9, 0.1);
  const double k = random.log_uniform(1.0, 1e4);
  const HeightFunction z = [&random, height, k](double x, double y) {
    return height * (std::sin(k * x) * std::cos(0.7 * k * y) + random.uniform(-1.0, 1.0));
  };
  const std::size_t cells_u = 1 + random.pick(5);
  const std::size_t cells_v = 1 + random.pick(5);
  if (!parametric) {
    const glm::dvec2 middle(random.uniform(-half, half), random.uniform(-half, half));
    return height_field(uneven_knots(random, middle.x - half, middle.x + half, cells_u),
                        uneven_knots(random, middle.y - half, middle.y + half, cells_v), z);
  }
  // An even net cannot fold; knots of any spacing over it stay one to one.
  lenses::BsplineSurface patch{uneven_knots(random, 0.0, 1.0, cells_u), uneven_knots(random, 0.0, 1.0, cells_v), {}};
  for (std::size_t i = 0; i < patch.count_u(); ++i) {
    for (std::size_t j = 0; j < patch.count_v(); ++j) {
      const double x = half * (2.0 * static_cast<double>(i) / static_cast<double>(patch.count_u() - 1) - 1.0);
      const double y = half * (2.0 * static_cast<double>(j) / static_cast<double>(patch.count_v() - 1) - 1.0);
      patch.control.emplace_back(x + 0.2 * y, y - 0.1 * x, z(x, y));
    }
  }
  return patch;
}

inline lenses::BasicSurface absurd_shape(Random& random, double semi_diameter) {
  switch (random.pick(kShapes)) {
    case 0:
      return lenses::Plane{};
    case 1:
      return lenses::Sphere{absurd_curvature(random)};
    case 2:
      return absurd_conic(random, semi_diameter);
    case 3:
      return absurd_torus(random);
    case 4:
      return absurd_spline(random, false);
    default:
      return absurd_spline(random, true);
  }
}

// As far, as steep and as high as a file may say, or hardly at all.
inline lenses::Placement absurd_placement(Random& random) {
  lenses::Placement placement;
  if (random.chance(0.5)) {
    const double far = random.log_uniform(1e-12, 0.1);
    placement.decentration = {random.uniform(-far, far), random.uniform(-far, far)};
  }
  if (random.chance(0.5)) {
    const double steep = random.log_uniform(1e-12, 2.0);
    placement.slope = {random.uniform(-steep, steep), random.uniform(-steep, steep)};
  }
  if (random.chance(0.5)) {
    placement.height = random.sign() * random.log_uniform(1e-12, 0.1);
  }
  return placement;
}

// Any closed polyline: crossing itself, level edges, corners that coincide.
inline lenses::SegmentedSurface absurd_segmented(Random& random, double semi_diameter) {
  lenses::SegmentedSurface surface;
  surface.base = absurd_shape(random, semi_diameter);
  surface.segment = random.chance(0.2) ? surface.base : absurd_shape(random, semi_diameter);
  surface.segment_placement = absurd_placement(random);
  const double reach = semi_diameter * random.log_uniform(1e-3, 3.0);
  const std::size_t corners = 3 + random.pick(20);
  for (std::size_t i = 0; i < corners; ++i) {
    glm::dvec2 corner(random.uniform(-reach, reach), random.uniform(-reach, reach));
    if (i > 0 && random.chance(0.3)) {
      corner.y = surface.boundary.back().y * (1.0 + random.sign() * random.log_uniform(1e-18, 1e-3));
    }
    surface.boundary.push_back(i > 0 && random.chance(0.1) ? surface.boundary.back() : corner);
  }
  return surface;
}

inline lenses::Surface absurd_surface(Random& random, double semi_diameter) {
  if (random.chance(0.2)) {
    return absurd_segmented(random, semi_diameter);
  }
  return std::visit([](auto&& s) { return lenses::Surface(s); }, absurd_shape(random, semi_diameter));
}

inline lenses::Lens absurd_lens(Random& random) {
  lenses::Lens lens;
  lens.index = random.chance(0.1) ? 1.0 : random.uniform(1.0, 4.0);
  lens.centre_thickness = random.chance(0.1) ? 0.0 : random.log_uniform(1e-6, 0.05);
  lens.diameter = random.log_uniform(1e-4, 0.2);
  lens.front = absurd_surface(random, 0.5 * lens.diameter);
  lens.back = absurd_surface(random, 0.5 * lens.diameter);
  if (random.chance(0.3)) {
    lens.front_placement = absurd_placement(random);
    lens.back_placement = absurd_placement(random);
  }
  lens.fit.vertex_distance = random.chance(0.2) ? 0.0 : random.uniform(0.0, 0.1);
  if (random.chance(0.5)) {
    lens.fit.decentration = {random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1)};
  }
  if (random.chance(0.5)) {
    lens.fit.pantoscopic_tilt = random.uniform(-89.0, 89.0) * kRadians;
    lens.fit.wrap = random.uniform(-89.0, 89.0) * kRadians;
  }
  lens.attached_to = random.chance(0.2) ? lenses::Lens::AttachedTo::eye : lenses::Lens::AttachedTo::head;
  return lens;
}

// Mostly ahead, so that lenses are met; else anywhere, along an axis, or straight back.
inline glm::dvec3 absurd_direction(Random& random) {
  const std::size_t kind = random.pick(10);
  if (kind == 0) {
    glm::dvec3 axis(0.0);
    axis[static_cast<int>(random.pick(3))] = random.sign();
    return axis;
  }
  if (kind == 1) {
    return glm::normalize(glm::dvec3(0.0, 0.0, random.sign()) + random.log_uniform(1e-18, 1e-3) * random.direction());
  }
  if (kind < 4) {
    return random.direction();
  }
  return random.direction_ahead(random.log_uniform(1e-4, 1.5));
}

inline double absurd_distance(Random& random) {
  return random.log_uniform(1e-6, 1e9);
}

}  // namespace support
