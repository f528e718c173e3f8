// Random numbers, surfaces and lenses for tests: ordinary ones that a wearer could have, and absurd ones that the file
// format allows. A test prints the seed it was given.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

#include "lenses/lens.hpp"
#include "lenses/lens_io/trace_io.hpp"

namespace support {

inline constexpr double kRadians = std::numbers::pi / 180.0;

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  double log_uniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  double sign() { return chance(0.5) ? 1.0 : -1.0; }
  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }
  std::size_t pick(std::size_t count) { return std::uniform_int_distribution<std::size_t>(0, count - 1)(engine_); }

  // Uniform on the sphere.
  glm::dvec3 direction() {
    const double z = uniform(-1.0, 1.0);
    const double angle = uniform(-std::numbers::pi, std::numbers::pi);
    const double flat = std::sqrt(1.0 - z * z);
    return {flat * std::cos(angle), flat * std::sin(angle), z};
  }
  // Ahead, at most `angle` off -z.
  glm::dvec3 direction_ahead(double angle) {
    const double off = uniform(0.0, angle);
    const double around = uniform(-std::numbers::pi, std::numbers::pi);
    return {std::sin(off) * std::cos(around), std::sin(off) * std::sin(around), -std::cos(off)};
  }

 private:
  std::mt19937_64 engine_;
};

// The shapes in the order of Surface, then any of them placed, and two of them as base and segment.
inline constexpr std::size_t kShapes = 6;
inline constexpr std::size_t kPlacedKind = 6, kSegmentedKind = 7;
inline constexpr std::size_t kSurfaceKinds = 8;
inline constexpr const char* kSurfaceNames[kSurfaceKinds] = {
    "plane", "sphere", "conic", "torus", "bspline_heights", "bspline_surface", "placed", "segmented"};

// Knots over [low, high] in `cells` intervals: end knots repeated, or continued at the same spacing.
inline std::vector<double> even_knots(double low, double high, std::size_t cells, bool repeat_ends) {
  std::vector<double> knots;
  const double step = (high - low) / static_cast<double>(cells);
  for (int i = -3; i <= static_cast<int>(cells) + 3; ++i) {
    const int k = repeat_ends ? std::clamp(i, 0, static_cast<int>(cells)) : i;
    knots.push_back(k == static_cast<int>(cells) ? high : low + step * k);
  }
  return knots;
}

// Uneven knots, some of them repeated.
inline std::vector<double> uneven_knots(Random& random, double low, double high, std::size_t cells) {
  std::vector<double> inner;
  for (std::size_t i = 1; i < cells; ++i) {
    if (!inner.empty() && random.chance(0.25) && std::count(inner.begin(), inner.end(), inner.back()) < 3) {
      inner.push_back(inner.back());
    } else {
      const double step = (high - low) / static_cast<double>(cells);
      inner.push_back(low + step * (static_cast<double>(i) + random.uniform(-0.4, 0.4)));
    }
  }
  std::vector<double> knots(4, low);
  knots.insert(knots.end(), inner.begin(), inner.end());
  knots.insert(knots.end(), 4, high);
  return knots;
}

// Where control point i of a cubic acts (Greville's abscissa).
inline double greville(const std::vector<double>& knots, std::size_t i) {
  return (knots[i + 1] + knots[i + 2] + knots[i + 3]) / 3.0;
}

using HeightFunction = std::function<double(double x, double y)>;

// The variation-diminishing spline of a function: as smooth as the function and near to it.
inline lenses::BsplineHeightField height_field(const std::vector<double>& knots_x, const std::vector<double>& knots_y,
                                               const HeightFunction& z) {
  lenses::BsplineHeightField spline{knots_x, knots_y, {}};
  for (std::size_t i = 0; i < spline.count_x(); ++i) {
    for (std::size_t j = 0; j < spline.count_y(); ++j) {
      spline.control_z.push_back(z(greville(knots_x, i), greville(knots_y, j)));
    }
  }
  return spline;
}

// The same over a parameter square [-1, 1]^2 of the given half width, x and y bent by up to `warp`.
inline lenses::BsplineSurface parametric_field(const std::vector<double>& knots_u, const std::vector<double>& knots_v,
                                               double half_width, double warp, const HeightFunction& z) {
  lenses::BsplineSurface spline{knots_u, knots_v, {}};
  for (std::size_t i = 0; i < spline.count_u(); ++i) {
    for (std::size_t j = 0; j < spline.count_v(); ++j) {
      const double u = greville(knots_u, i);
      const double v = greville(knots_v, j);
      const double x = half_width * (u + warp * std::sin(2.0 * v + 0.3) * std::cos(u));
      const double y = half_width * (v + warp * std::cos(1.7 * u) * std::sin(v + 0.2));
      spline.control.emplace_back(x, y, z(x, y));
    }
  }
  return spline;
}

// A sphere's sag with gentle waves on it (a progressive's scale of unevenness: about a dioptre).
inline HeightFunction wavy_sphere(Random& random, double curvature) {
  const double height = random.uniform(2e-5, 8e-5);
  const double kx = random.uniform(60.0, 120.0);
  const double ky = random.uniform(60.0, 120.0);
  const double phase = random.uniform(-3.0, 3.0);
  return [=](double x, double y) {
    const double r2 = std::min(x * x + y * y, 0.9 / std::max(curvature * curvature, 1e-9));
    return curvature * r2 / (1.0 + std::sqrt(1.0 - curvature * curvature * r2)) +
           height * (std::sin(kx * x + phase) * std::cos(ky * y) - std::sin(phase));
  };
}

// A shape (index into BasicSurface) that curves about like a sphere of this curvature.
inline lenses::BasicSurface ordinary_shape(Random& random, std::size_t kind, double curvature) {
  const double half = 0.045;
  switch (kind) {
    case 0:
      return lenses::Plane{};
    case 2:
      return lenses::Conic{
          curvature, random.uniform(-1.5, 0.5), {random.uniform(-5.0, 5.0), random.uniform(-2e3, 2e3)}};
    case 3:
      return lenses::Torus{curvature, curvature + random.uniform(-6.0, 6.0), random.uniform(0.0, std::numbers::pi),
                           random.chance(0.5) ? lenses::Torus::Revolve::u : lenses::Torus::Revolve::v};
    case 4: {
      const std::size_t cells = 8 + random.pick(6);
      return height_field(even_knots(-half, half, cells, random.chance(0.5)), even_knots(-half, half, cells + 1, false),
                          wavy_sphere(random, curvature));
    }
    case 5: {
      const std::size_t cells = 5 + random.pick(3);
      const auto knots = even_knots(-1.0, 1.0, cells, random.chance(0.5));
      return parametric_field(knots, knots, half, 0.08, wavy_sphere(random, curvature));
    }
    default:
      return lenses::Sphere{curvature};
  }
}

// Some prism dioptres, some millimetres off the axis.
inline lenses::Placement ordinary_placement(Random& random) {
  return {{random.uniform(-0.004, 0.004), random.uniform(-0.004, 0.004)},
          {random.uniform(-0.04, 0.04), random.uniform(-0.04, 0.04)},
          random.uniform(-1e-4, 1e-4)};
}

// A circle about `centre` cut off flat at `top` above it, or any other polygon that goes once around.
inline std::vector<glm::dvec2> ordinary_boundary(Random& random) {
  const glm::dvec2 centre(random.uniform(-0.004, 0.004), random.uniform(-0.012, 0.0));
  const double radius = random.uniform(0.008, 0.016);
  const double top = random.uniform(0.2, 1.0) * radius;
  const std::size_t corners = 3 + random.pick(40);
  const double turned = random.uniform(0.0, 1.0);
  std::vector<glm::dvec2> boundary;
  for (std::size_t i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * (static_cast<double>(i) + turned) / static_cast<double>(corners);
    boundary.push_back(centre + glm::dvec2(radius * std::cos(angle), std::min(top, radius * std::sin(angle))));
  }
  return boundary;
}

// Curved about like a sphere of this curvature, the segment up to 3 D more; a ledge of about a tenth of a millimetre.
inline lenses::SegmentedSurface ordinary_segmented(Random& random, double curvature) {
  lenses::SegmentedSurface surface;
  surface.base = ordinary_shape(random, random.pick(kShapes), curvature);
  surface.segment = ordinary_shape(random, random.pick(kShapes), curvature + random.uniform(1.0, 6.0));
  surface.segment_placement = ordinary_placement(random);
  surface.segment_placement.decentration.y -= 0.006;
  surface.boundary = ordinary_boundary(random);
  return surface;
}

// Of the given kind (index into kSurfaceNames).
inline void set_ordinary_surface(Random& random, std::size_t kind, double curvature, lenses::Surface& surface,
                                 lenses::Placement& placement) {
  if (kind == kSegmentedKind) {
    surface = ordinary_segmented(random, curvature);
  } else {
    const std::size_t shape = kind == kPlacedKind ? random.pick(kShapes) : kind;
    surface = std::visit([](auto&& s) { return lenses::Surface(s); }, ordinary_shape(random, shape, curvature));
  }
  placement = kind >= kShapes ? ordinary_placement(random) : lenses::Placement{};
}

// Spectacles that could be worn: 2 to 9 D in front, -8 to +6 D in all, thick enough at the edge and in the middle.
inline lenses::Lens ordinary_lens(Random& random, std::size_t front_kind, std::size_t back_kind) {
  lenses::Lens lens;
  lens.index = random.uniform(1.49, 1.74);
  const double front_power = front_kind == 0 ? 0.0 : random.uniform(2.0, 9.0);
  const double power = random.uniform(-8.0, 6.0);
  const double front = front_power / (lens.index - 1.0);
  const double back = back_kind == 0 ? 0.0 : (front_power - power) / (lens.index - 1.0);
  lens.diameter = 0.056;
  const double edge_loss = 0.5 * (front - back) * 0.028 * 0.028;
  lens.centre_thickness = 0.0025 + std::max(0.0, 1.3 * edge_loss);
  set_ordinary_surface(random, front_kind, front, lens.front, lens.front_placement);
  set_ordinary_surface(random, back_kind, back, lens.back, lens.back_placement);
  lens.fit.vertex_distance = random.uniform(0.010, 0.018);
  lens.fit.decentration = {random.uniform(-0.004, 0.004), random.uniform(-0.004, 0.004)};
  lens.fit.pantoscopic_tilt = random.uniform(-5.0, 15.0) * kRadians;
  lens.fit.wrap = random.uniform(-5.0, 20.0) * kRadians;
  return lens;
}

inline lenses::Lens ordinary_lens(Random& random) {
  return ordinary_lens(random, random.pick(kSurfaceKinds), random.pick(kSurfaceKinds));
}

inline lenses::TraceRequest ordinary_request(Random& random, const lenses::Lens& lens,
                                             double widest = 35.0 * kRadians) {
  using Viewing = lenses::TraceRequest::Viewing;
  lenses::TraceRequest request;
  request.lens = lens;
  request.side = random.chance(0.5) ? lenses::Side::right : lenses::Side::left;
  request.viewing = std::array{Viewing::fixed, Viewing::scanning, Viewing::gaze}[random.pick(3)];
  request.direction = random.direction_ahead(widest);
  request.gaze = random.direction_ahead(25.0 * kRadians);
  if (random.chance(0.6)) {
    request.object_distance = random.log_uniform(0.15, 100.0);
  }
  return request;
}

}  // namespace support
