// The options of `vergence lens from-prescription`, and what they ask for.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "lenses/design/lens_request.hpp"

namespace app {

// As given on the command line; what is absent follows by rule.
struct PrescriptionOptions {
  double sphere = 0.0, cylinder = 0.0, add = 0.0;
  std::optional<double> axis, index, abbe, base_curve, centre_thickness, diameter, min_centre, min_edge, segment_top,
      inset, corridor, back_radius, vertex, panto, wrap, refraction_vertex;
  std::vector<std::string> prism;
  std::string material, design, side, outline;
  std::string front = "spherical", toric = "tyre", prism_by = "tilt", segment = "ft28", contact = "soft",
              progressive_surface = "eye_side";
  bool thinning = false, as_worn = false, json = false;
  std::string output = "lens.json";
};

void add_prescription_options(CLI::App& command, PrescriptionOptions& options);

struct RequestedLens {
  lenses::LensRequest request;
  std::optional<double> density;  // kg/m^3, where the material has a name
};

// Throws InputError of the option, or of the outline's file.
[[nodiscard]] RequestedLens requested_lens(const PrescriptionOptions& options);

// The option that a field of the request comes from, as lens files name the field.
[[nodiscard]] std::string option_of(const std::string& field);

}  // namespace app
