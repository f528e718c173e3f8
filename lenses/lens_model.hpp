// A lens or an eye turned into the numbers the engines trace with: lenses/gpu's structures and the table of spline
// coefficients. Everything is computed in double; `to_float` rounds once, at the end.
#pragma once

#include <string>
#include <vector>

#include "lenses/engine.hpp"
#include "lenses/lens.hpp"

namespace lenses {

// Lens data of one or several lenses and the table their splines live in.
struct LensModel {
  std::vector<f64::LensData> lens;
  std::vector<glm::dvec4> table;
};

// Appends a lens (nullptr: no lens, the bare eye) and returns its index. Throws std::invalid_argument, with the reason,
// for a spline whose parametrisation folds over.
std::size_t append_lens(LensModel& model, const Lens* lens, Side side, double entrance_pupil_depth);

// accommodation_amplitude and pupil_diameter: what the wearer file says, or what follows from age and light.
[[nodiscard]] f64::EyeData make_eye_data(const Eye& eye, double accommodation_amplitude, double pupil_diameter);

[[nodiscard]] f32::LensData to_float(const f64::LensData& lens);
[[nodiscard]] f32::EyeData to_float(const f64::EyeData& eye);
[[nodiscard]] std::vector<glm::vec4> to_float(const std::vector<glm::dvec4>& table);

}  // namespace lenses
