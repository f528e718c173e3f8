// What the records of a job say, in SI units and the wearer's axes. Records that the standard leaves to two readings:
// FRNT and BACK beyond 20 in magnitude are radii in mm, positive with the centre on the eye side, else surface powers
// in dioptres for the tooling index TIND (1.53 where it is absent); NWD beyond 150 is in mm, else in cm.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "lenses/lens_io/oma_job.hpp"
#include "lenses/lens_io/sdf.hpp"

namespace lenses {

struct OmaEye {
  std::optional<Prescription> prescription;   // SPH CYL AX ADD PRVM PRVA
  std::optional<Prescription> designed;       // LDDRSPH LDDRCYL LDDRAX LDADD: the power it was computed to
  std::optional<Prescription> designed_near;  // LDNRSPH LDNRCYL LDNRAX
  std::optional<double> far_pd, near_pd;      // IPD NPD: monocular, m
  std::optional<double> optical_centre_height, fitting_height;  // OCHT SEGHT, above the lower box line, m
  std::optional<double> box_width, box_height;                  // HBOX VBOX, m
  std::optional<double> vertex_distance;                        // BVD, m
  std::optional<double> pantoscopic_tilt, wrap;                 // PANTO ZTILT, rad
  std::optional<double> index, centre_thickness;                // LIND, CTHICK (m)
  std::optional<double> corridor_length;                        // CORRLEN, m
  // BCSGIN/UP, BCDRPIN/UP, BCNRPIN/UP, from the blank's centre, m.
  std::optional<glm::dvec2> fitting_cross, distance_point, near_point;
  std::optional<double> front_curvature, back_curvature;  // FRNT BACK, 1/m
  std::vector<glm::dvec2> outline;                        // from the box's centre, counter-clockwise, m
  std::optional<SagSamples> front_surface, back_surface;
};

enum class OmaLensType { single_vision, bifocal, progressive };

struct OmaOrder {
  std::array<bool, 2> wanted{true, true};  // DO, indexed by Side
  std::array<OmaEye, 2> eye;               // indexed by Side
  std::array<std::optional<OmaLensType>, 2> type;
  std::optional<double> bridge;         // DBL, m
  std::optional<double> near_distance;  // NWD, m
};

// Throws tracking::InputError for a record that is none of the forms it may have.
[[nodiscard]] OmaOrder read_order(const io::OmaJob& job, RowOrder rows = RowOrder::top_first);

// Boxed lens (ISO 8624): where the wearer's pupil, or the height asked for, lies from the box's centre; a part that
// needs a record that is not there is 0.
[[nodiscard]] glm::dvec2 pupil_in_box(const OmaOrder& order, Side side, bool fitting_height);

}  // namespace lenses
