// Rays in, wavefronts out: the double-precision reference engine, and the parts any engine of the `trace` command
// shares (building the batch, reading an engine's records).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "lenses/lens_io/trace_io.hpp"
#include "lenses/lens_model.hpp"
#include "lenses/trace_result.hpp"

namespace lenses {

// Subjective estimates such as Hofstetter's are far too generous; this is the objective amplitude (Anderson et al.
// 2008), D.
[[nodiscard]] double accommodation_amplitude_at(double age);

inline constexpr double kDefaultPupilDiameter = 0.0035;  // m, paper section 5.4
inline constexpr double kDefaultAge = 35.0;              // years

// What an engine needs for a batch of requests. Requests through the lens of one of the last few share its model.
struct TraceBatch {
  struct KnownLens {
    Lens lens;
    Side side;
    double entrance_pupil_depth;
    std::size_t index;
  };

  std::vector<KnownLens> recent;
  std::optional<std::size_t> bare;  // the index that stands for no lens
  LensModel model;
  std::vector<f64::EyeData> eyes;
  std::vector<f64::TraceInput> rays;
};

// Forgets the rays; the lenses stay, until they take so much memory that starting anew is cheaper.
void next_batch(TraceBatch& batch);

// Throws std::invalid_argument for a lens that cannot be modelled (see append_lens).
void append_request(TraceBatch& batch, const TraceRequest& request);

[[nodiscard]] std::vector<f64::TraceOutput> trace_reference(const TraceBatch& batch);
// The same in single precision on the CPU: what the shaders compute, without a GPU.
[[nodiscard]] std::vector<f32::TraceOutput> trace_reference_float(const TraceBatch& batch);

// An engine's record as the command reports it; `ray` is the request's input.
[[nodiscard]] TraceResult to_result(const f64::TraceOutput& record, const f64::TraceInput& ray, bool has_lens);
[[nodiscard]] TraceResult to_result(const f32::TraceOutput& record, const f64::TraceInput& ray, bool has_lens);

}  // namespace lenses
