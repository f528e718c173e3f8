// Jobs into spectacles and back. What a job gives is taken: tabulated surfaces, radii, thickness, index, frame; what it
// leaves open follows from its prescription.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "lenses/lens_io/oma_order.hpp"
#include "lenses/spline_fit.hpp"

namespace lenses {

// Where a surface of a lens came from.
struct SurfaceOrigin {
  enum class Kind { tabulated, radius, prescription };
  Kind kind = Kind::prescription;
  std::optional<SplineFit> fit;  // tabulated
};

struct JobLens {
  Lens lens;
  SurfaceOrigin front, back;
  bool made = true;  // false: the job does not ask for this eye, and the lens is a plano one
};

struct JobSpectacles {
  Spectacles spectacles;
  std::array<JobLens, 2> lens;  // indexed by Side
};

struct JobReading {
  RowOrder rows = RowOrder::top_first;
  double index = 1.498;  // where the job has no LIND
  SplineFitConfig fit = {};
};

// Throws tracking::InputError, the field being the job's record, where the lenses cannot be made.
[[nodiscard]] JobSpectacles spectacles_of(const io::OmaJob& job, const JobReading& reading = {});

struct JobWriting {
  // The job to bring up to date: records that still hold stay as they are, byte for byte, and so do those that
  // spectacles know nothing of. None: a new one.
  std::optional<io::OmaJob> base = {};
  std::array<double, 2> pupillary_distance{0.0315, 0.0315};  // monocular, m; for a frame whose bridge nobody gave
  RowOrder rows = RowOrder::top_first;
  std::size_t grid = 71;  // columns and rows of tabulated surfaces
};

// Throws tracking::InputError, the field being of the spectacles, where they have no form as a job.
[[nodiscard]] io::OmaJob job_of(const Spectacles& spectacles, const std::string& file, const JobWriting& writing = {});

}  // namespace lenses
