// The example spectacles and the single example lens, as the JSON texts that are committed beside the generator.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "lenses/lens.hpp"

namespace assets {

// The right lens's progressive front: the closed form in the wearer's axes (x mirrored), near zone toward -x, fitted
// with count x count control points.
[[nodiscard]] lenses::BsplineHeightField progressive_front_right(std::size_t count = 50);

// Lenses of single vision from their order (TABO), in the wearer's axes: back vertex power
// F1 / (1 - t F1 / n) + F2 in both meridians is the order's.
struct SingleVision {
  double sphere = 0.0, cylinder = 0.0, axis_deg = 0.0;  // D, D, TABO
  double base_curve = 5.0;                              // front power, D
  double centre_thickness = 0.002, diameter = 0.065;    // m
};
[[nodiscard]] nlohmann::ordered_json single_vision_lens(const SingleVision& order);

// File contents by path relative to assets/.
[[nodiscard]] std::map<std::string, std::string> spectacles_files();

// The progressive pair with a back of a sphere again, its fronts of 100 x 100 control points: the benchmark's answer to
// what a finer net costs.
[[nodiscard]] std::string fine_net_pair();

}  // namespace assets
