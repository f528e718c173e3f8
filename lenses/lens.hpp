// What a lens, a pair of spectacles, an eye and a wearer are, in SI units (metres, radians, dioptres as 1/m).
// Readers and writers are in lens_io; nothing here does I/O.
#pragma once

#include <array>
#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "lenses/prescription.hpp"
#include "tracking/live_config.hpp"
#include "tracking/stereo_view.hpp"

namespace lenses {

using tracking::Side;

// Surfaces are height fields z = sag(x, y) over the lens plane, vertex at the origin; a curvature is positive when its
// centre lies on the eye side (+z).
struct Plane {
  bool operator==(const Plane&) const = default;
};

struct Sphere {
  double curvature = 0.0;  // 1/m
  bool operator==(const Sphere&) const = default;
};

struct Conic {
  double curvature = 0.0;                 // 1/m
  double conic_constant = 0.0;            // -1 is a parabola
  std::vector<double> even_coefficients;  // a4, a6, ... for r in metres: m^(1-4), m^(1-6), ...
  bool operator==(const Conic&) const = default;
};

struct Torus {
  enum class Revolve { u, v };
  double curvature_u = 0.0, curvature_v = 0.0;  // normal curvatures at the vertex, 1/m
  double axis = 0.0;                            // u direction from +x, counter-clockwise as the wearer sees it, radians
  Revolve revolve = Revolve::u;                 // u: the arc of curvature_v is turned about a line parallel to v
  bool operator==(const Torus&) const = default;
};

// Bicubic tensor-product height field; knots.size() = count + 4.
struct BsplineHeightField {
  std::vector<double> knots_x, knots_y;  // m, non-decreasing
  std::vector<double> control_z;         // m, [i * count_y + j], i along x
  [[nodiscard]] std::size_t count_x() const { return knots_x.size() - 4; }
  [[nodiscard]] std::size_t count_y() const { return knots_y.size() - 4; }
  bool operator==(const BsplineHeightField&) const = default;
};

// Bicubic parametric surface (u, v) -> (x, y, z); must be a graph over the lens plane: d(x, y)/d(u, v) > 0.
struct BsplineSurface {
  std::vector<double> knots_u, knots_v;
  std::vector<glm::dvec3> control;  // m, [i * count_v + j], i along u
  [[nodiscard]] std::size_t count_u() const { return knots_u.size() - 4; }
  [[nodiscard]] std::size_t count_v() const { return knots_v.size() - 4; }
  bool operator==(const BsplineSurface&) const = default;
};

using BasicSurface = std::variant<Plane, Sphere, Conic, Torus, BsplineHeightField, BsplineSurface>;

// Where a surface stands in the lens: z = sag((x, y) - decentration) + slope . (x, y) + height. A slope is what gives a
// lens prism: about (index - 1) * slope radians, the base where the glass is thicker.
struct Placement {
  glm::dvec2 decentration{0.0};  // m
  glm::dvec2 slope{0.0};         // dz/dx, dz/dy
  double height = 0.0;           // m
  bool operator==(const Placement&) const = default;
};

// A bifocal's surface: inside the boundary the segment counts, outside it the base. Where the two do not meet at the
// same height the boundary is a ledge; a ray into its wall meets no surface and has status miss_front, on either side
// of the lens. The lens's placement of the surface moves base and segment together; segment_placement comes on top of
// it (the decentrations add, so do slopes and heights). The boundary stays in lens axes.
struct SegmentedSurface {
  BasicSurface base, segment;
  Placement segment_placement;
  std::vector<glm::dvec2> boundary;  // m; a closed polygon of at least 3 points, inside by the even-odd rule
  bool operator==(const SegmentedSurface&) const = default;
};

using Surface = std::variant<Plane, Sphere, Conic, Torus, BsplineHeightField, BsplineSurface, SegmentedSurface>;

struct Fit {
  double vertex_distance = 0.013;  // cornea to back vertex, m
  glm::dvec2 decentration{0.0};    // lens origin minus the primary line of sight, wearer's axes, m
  double pantoscopic_tilt = 0.0;   // radians, > 0 brings the bottom edge toward the face
  double wrap = 0.0;               // radians, > 0 brings the temporal edge toward the face
  bool operator==(const Fit&) const = default;
};

struct ReferencePoints {
  std::optional<glm::dvec2> fitting_cross, distance, near, prism;  // m, lens axes
  bool operator==(const ReferencePoints&) const = default;
};

struct Lens {
  enum class AttachedTo { head, eye };
  double index = 1.5;
  double abbe = 58.0;
  double centre_thickness = 0.002;  // m
  double diameter = 0.065;          // m; a hit farther than half of it from the lens axis misses
  Surface front = Plane{}, back = Plane{};
  Placement front_placement, back_placement;
  Fit fit;
  ReferencePoints reference_points;
  std::vector<glm::dvec2> outline;  // m, empty: round
  AttachedTo attached_to = AttachedTo::head;
  std::optional<Order> order;  // what the lens was made for
  bool operator==(const Lens&) const = default;
};

struct Spectacles {
  std::string name;
  std::array<Lens, 2> lens;           // indexed by Side
  glm::dvec3 tint_transmission{1.0};  // linear r, g, b
};

// The correcting lens as written on a prescription; axis in TABO (ISO 8429, as the examiner sees it), radians.
struct Refraction {
  double sphere = 0.0, cylinder = 0.0, axis = 0.0;  // D, D, radians
};

struct RelaxedPower {
  double q1 = 40.0, q2 = 40.0;  // D
  double axis = 0.0;            // meridian of q1 as the wearer sees it, radians
};

struct Zernike {
  double pupil_diameter = 0.006;     // m
  std::vector<double> coefficients;  // m, OSA/ANSI single index from j = 0, examiner's axes
};

struct Eye {
  double axial_length = 0.025;                    // m
  std::optional<double> pupil_diameter;           // m; absent: 3.5 mm, or from the headset's luminance and the age
  std::optional<double> accommodation_amplitude;  // D; absent: by age
  std::variant<std::monostate, Refraction, RelaxedPower> power;  // monostate: emmetropic
  double refraction_vertex = 0.013;                              // m
  double entrance_pupil_depth = 0.00305;                         // behind the cornea, m
  double centre_of_rotation_depth = 0.0135;                      // behind the cornea, m
  std::optional<Zernike> zernike;
};

// The person inside the headset, whose own eye looks at the display.
struct Viewer {
  enum class Worn { nothing, contacts, spectacles, inserts };
  Refraction refraction;
  Worn worn_in_headset = Worn::nothing;
  std::optional<double> accommodation_amplitude;  // D
};

struct Wearer {
  std::string name;
  double age = 35.0;                                         // years
  std::array<double, 2> pupillary_distance{0.0315, 0.0315};  // monocular, m, indexed by Side
  std::array<Eye, 2> eye;                                    // indexed by Side
  std::array<std::optional<Viewer>, 2> viewer;               // indexed by Side
  std::optional<double> viewer_age;                          // years; absent: the wearer's
  tracking::LiveConfig live;                                 // how eyes and tracker behave in time
};

}  // namespace lenses
