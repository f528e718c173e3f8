#include "lenses/lens_io/surface_reader.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "lenses/lens_io/bspline_reader.hpp"
#include "lenses/lens_io/file_surface_reader.hpp"
#include "lenses/lens_io/placement_reader.hpp"
#include "lenses/lens_io/polygon_reader.hpp"
#include "lenses/lens_io/units.hpp"

namespace lenses::io {
namespace {

// Far below any optical surface and far above where a curvature or its square would overflow.
constexpr double kLeastRadiusMm = 1e-3;
constexpr std::size_t kMostEvenCoefficients = 8;

constexpr std::size_t kMostBoundaryPoints = 512;

constexpr const char* kBasicTypes =
    "one of \"plane\" \"sphere\" \"conic\" \"torus\" \"bspline\" \"bspline_surface\" \"file\"";
constexpr const char* kTypes =
    "one of \"plane\" \"sphere\" \"conic\" \"torus\" \"bspline\" \"bspline_surface\" \"file\" \"segment\"";

double read_curvature(const Field& surface, std::string_view key) {
  const std::string expected =
      "a radius of at least 0.001 in magnitude, positive when the centre is on the eye side, or null for flat";
  const Field field = surface.require(key, expected);
  if (field.is_null()) return 0.0;
  if (!field.value().is_number()) field.fail_type(expected);
  const double radius_mm = field.value().get<double>();
  if (std::abs(radius_mm) < kLeastRadiusMm) field.fail_type(expected);
  return curvature_from_radius_mm(radius_mm);
}

Sphere read_sphere(const Field& surface) {
  surface.allow_only({"type", "radius_mm"}, kPlacementKeys);
  return {read_curvature(surface, "radius_mm")};
}

Conic read_conic(const Field& surface) {
  surface.allow_only({"type", "radius_mm", "conic_constant", "even_coefficients", "even_coefficients_mm"},
                     kPlacementKeys);
  Conic conic;
  conic.curvature = read_curvature(surface, "radius_mm");
  surface.read("conic_constant", plain(-1e4, 1e4), conic.conic_constant);
  // A name without a unit is SI, as the traced cases have it: a4 in m^-3. Designs list a4 in mm^-3: the name with _mm.
  const auto si = surface.find("even_coefficients");
  if (si) {
    conic.even_coefficients = si->numbers(plain(-1e30, 1e30), 0, kMostEvenCoefficients);
  }
  if (const auto coefficients = surface.find("even_coefficients_mm")) {
    if (si) coefficients->fail("stands beside even_coefficients; only one of the two is allowed");
    conic.even_coefficients = coefficients->numbers(plain(-1.0, 1.0), 0, kMostEvenCoefficients);
    for (std::size_t i = 0; i < conic.even_coefficients.size(); ++i) {
      conic.even_coefficients[i] *= even_coefficient_scale(i);
    }
  }
  return conic;
}

Torus read_torus(const Field& surface) {
  surface.allow_only({"type", "radius_u_mm", "radius_v_mm", "axis_deg", "revolve"}, kPlacementKeys);
  Torus torus;
  torus.curvature_u = read_curvature(surface, "radius_u_mm");
  torus.curvature_v = read_curvature(surface, "radius_v_mm");
  if (const auto axis = surface.find("axis_deg")) torus.axis = axis->axis();
  if (const auto revolve = surface.find("revolve")) {
    torus.revolve = revolve->choice<Torus::Revolve>({{"u", Torus::Revolve::u}, {"v", Torus::Revolve::v}});
  }
  return torus;
}

// What a bifocal's base and segment may be.
BasicSurface read_basic_surface(const Field& surface, const char* types) {
  const Field type = surface.require("type", types);
  const std::string& name = type.text(types);
  if (name == "plane") {
    surface.allow_only({"type"}, kPlacementKeys);
    return Plane{};
  }
  if (name == "sphere") return read_sphere(surface);
  if (name == "conic") return read_conic(surface);
  if (name == "torus") return read_torus(surface);
  if (name == "bspline") return read_bspline_height_field(surface);
  if (name == "bspline_surface") return read_bspline_surface(surface);
  if (name == "file") return read_file_surface(surface);
  type.fail_type(types);
}

SegmentedSurface read_segmented(const Field& surface) {
  surface.allow_only({"type", "base", "segment", "boundary_mm"}, kPlacementKeys);
  const Field base = surface.require("base", "a surface");
  const Field segment = surface.require("segment", "a surface");
  SegmentedSurface result{
      read_basic_surface(base, kBasicTypes), read_basic_surface(segment, kBasicTypes), read_placement(segment), {}};
  for (const std::string_view key : kPlacementKeys) {
    if (const auto found = base.find(key)) {
      found->fail("is not allowed on a base; allowed on the whole surface, beside base, and on its segment");
    }
  }
  result.boundary = read_polygon(surface.require("boundary_mm", "an array of [x, y] points"), kMostBoundaryPoints);
  return result;
}

}  // namespace

Surface read_surface(const Field& surface) {
  const Field type = surface.require("type", kTypes);
  if (type.text(kTypes) == "segment") return read_segmented(surface);
  return std::visit([](auto&& basic) { return Surface(std::move(basic)); }, read_basic_surface(surface, kTypes));
}

}  // namespace lenses::io
