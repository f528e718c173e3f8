// Surface records of the OMA / VCA standard, in a file of their own (.sdf) or within a job:
//   SURFMT=1;R;F;71;71;70;70;0   format; side R, L or B; surface F(ront) or B(ack); columns; rows; width, height in mm;
//   0 ZZ=z;z;...                   a line a row, mm
#pragma once

#include <vector>

#include "lenses/lens_io/oma_job.hpp"
#include "lenses/lens_io/sag_file.hpp"

namespace lenses::io {

struct SdfSurface {
  std::optional<Side> side;  // absent: both
  Face face = Face::front;
  std::size_t line = 0;  // of its SURFMT record, from 0
  SagSamples samples;
};

// Every surface of a job or file, in order.
[[nodiscard]] std::vector<SdfSurface> sdf_surfaces(const OmaJob& job, RowOrder rows);

}  // namespace lenses::io
