// vergence lens from-sdf and to-sdf: lenses from tabulated surfaces (SDF, HMF, XYZ), and back.
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <variant>

#include "app/commands.hpp"
#include "app/lens_file_options.hpp"
#include "app/option_values.hpp"
#include "lenses/lens_io/json_text.hpp"
#include "lenses/lens_io/lens_io.hpp"
#include "lenses/lens_io/lens_or_spectacles.hpp"
#include "lenses/sag_grid.hpp"
#include "tracking/input_error.hpp"

namespace app {
namespace {

using lenses::Face;
using lenses::Lens;
using lenses::Side;
using tracking::InputError;

constexpr double kMm = 1e-3;
constexpr double kPatchMargin = 1e-9;  // of the diameter, so that rounding does not leave the patch

struct FromOptions {
  SagOptions sag;
  std::string input, lens, other_radius, output = "lens.json";
  std::optional<double> index, abbe, centre_thickness, diameter;
  bool json = false;
};

// The sphere that makes a lens of no power on its axis with a surface of this mean curvature there.
lenses::Surface plano_partner(Face given, double curvature, const Lens& lens) {
  const double n = lens.index, reduced = lens.centre_thickness / n;
  const double power = (n - 1.0) * curvature;
  const double partner = given == Face::front ? power / (1.0 - reduced * power) : power / (1.0 + reduced * power);
  if (partner == 0.0) return lenses::Plane{};
  return lenses::Sphere{partner / (n - 1.0)};
}

double mean_curvature_on_axis(const lenses::BsplineHeightField& surface) {
  Lens lens;
  lens.front = surface;
  const double h = 1e-4;  // m; the spline is smooth over that
  const auto grid = sag_grid(lens, Face::front, 3, 2.0 * h);
  const auto z = [&](std::size_t i, std::size_t j) { return grid.sag[i * 3 + j]; };
  return 0.5 * (z(0, 1) + z(2, 1) + z(1, 0) + z(1, 2) - 4.0 * z(1, 1)) / (h * h);
}

lenses::Surface other_surface(const FromOptions& options, Face given, const lenses::BsplineHeightField& surface,
                              const Lens& lens) {
  if (options.other_radius.empty()) return plano_partner(given, mean_curvature_on_axis(surface), lens);
  if (options.other_radius == "flat") return lenses::Plane{};
  const double radius = numbers_of("--other-radius", options.other_radius, 1,
                                   "flat or a radius in mm, positive with its centre on the eye side")
                            .front();
  if (std::abs(radius) < 1.0) throw InputError("--other-radius", "", "is too short; at least 1 mm, or flat");
  return lenses::Sphere{1e3 / radius};
}

// Of the largest circle about the axis within the patch.
double patch_diameter(const lenses::BsplineHeightField& s, const std::string& file) {
  const auto reach = [](const std::vector<double>& knots) { return std::min(-knots[3], knots[knots.size() - 4]); };
  const double radius = std::min(reach(s.knots_x), reach(s.knots_y));
  if (!(radius > 0.0))
    throw InputError(file, "", "does not reach the lens axis; x = 0, y = 0 must lie inside the table");
  return 2.0 * radius * (1.0 - kPatchMargin);
}

void set_glass(const FromOptions& o, Lens& lens) {
  if (o.index) {
    check_range("--index", *o.index, 1.0, 4.0, "");
    lens.index = *o.index;
  }
  if (o.abbe) {
    check_range("--abbe", *o.abbe, 5.0, 200.0, "");
    lens.abbe = *o.abbe;
  }
  if (o.centre_thickness) {
    check_range("--centre-thickness", *o.centre_thickness, 0.0, 200.0, "mm");
    lens.centre_thickness = *o.centre_thickness * kMm;
  }
  if (o.diameter) check_range("--diameter", *o.diameter, 1.0, 500.0, "mm");
}

int from_sdf(const FromOptions& options) {
  const lenses::SagFile table = lenses::read_sag_file(
      options.input, {options.sag.row_order(), options.sag.chosen_side(), options.sag.chosen_face()},
      options.sag.sag_format());
  const lenses::SplineFit fit = fit_sag_file(table, options.input, options.sag.fit_config());
  const Face face = options.sag.chosen_face().value_or(table.face.value_or(Face::front));
  Lens lens;
  lens.index = 1.6;
  lens.abbe = 41.0;
  if (!options.lens.empty()) lens = lenses::read_lens(options.lens);
  set_glass(options, lens);
  const bool front = face == Face::front;
  (front ? lens.front : lens.back) = fit.surface;
  (front ? lens.front_placement : lens.back_placement) = {};
  const double widest = patch_diameter(fit.surface, options.input);
  if (options.diameter && *options.diameter * kMm > widest) {
    throw InputError("--diameter", "", "is beyond the table, which reaches over " + shown_text(1e3 * widest) + " mm");
  }
  lens.diameter =
      options.diameter ? *options.diameter * kMm : (options.lens.empty() ? widest : std::min(widest, lens.diameter));
  if (options.lens.empty() || !options.other_radius.empty()) {
    (front ? lens.back : lens.front) = other_surface(options, face, fit.surface, lens);
    (front ? lens.back_placement : lens.front_placement) = {};
  }
  write_text(options.output, to_json(lens));
  const char* name = front ? "front" : "back";
  if (options.json) {
    print_text(lenses::io::document_text({{"output", options.output},
                                          {"surface", name},
                                          {"diameter_mm", shown(1e3 * lens.diameter, 6)},
                                          {"index", lens.index},
                                          {"fit", fit_report(fit, lens.index)}}));
  } else {
    print_text(options.output + ": " + name + " of " + fit_text(fit, lens.index) + "\n");
  }
  return 0;
}

struct ToOptions {
  SagOptions sag;
  std::string input, output = "surface.sdf";
  int count = 71, decimals = 6;
  std::optional<double> size;
  bool json = false;
};

Lens lens_of(const std::string& file, Side side) {
  const auto read = lenses::read_lens_or_spectacles(file);
  if (const auto* lens = std::get_if<Lens>(&read)) return *lens;
  return std::get<lenses::Spectacles>(read).lens[static_cast<std::size_t>(side)];
}

int to_sdf(const ToOptions& options) {
  check_range("--count", options.count, 4, 1000, "");
  check_range("--decimals", options.decimals, 1, 12, "");
  if (options.size) check_range("--size", *options.size, 1.0, 500.0, "mm");
  auto format = options.sag.sag_format();
  if (!format) format = lenses::sag_format_of(options.output);
  if (!format)
    throw InputError("--output", "",
                     "'" + options.output + "' has no ending that names a format; .sdf, .hmf, .xyz or --format");
  const Side side = options.sag.chosen_side().value_or(Side::right);
  const Face face = options.sag.chosen_face().value_or(Face::front);
  const Lens lens = lens_of(options.input, side);
  const lenses::SagWriting writing{options.sag.row_order(), side, face, options.decimals};
  std::string text;
  lenses::SagGrid grid;
  try {
    const auto size = options.size ? std::optional(*options.size * kMm) : std::nullopt;
    grid = sag_grid(lens, face, static_cast<std::size_t>(options.count), size);
    text = to_sag(*format, grid, writing);
  } catch (const std::invalid_argument& error) {
    throw InputError(options.input, face == Face::front ? "front" : "back", error.what());
  }
  // What a reader of the file will find.
  const lenses::SplineFit fit =
      fit_sag_file(parse_sag(*format, text, options.output, {writing.rows, side, face}), options.output);
  write_text(options.output, text);
  if (options.json) {
    print_text(lenses::io::document_text({{"output", options.output},
                                          {"size_mm", shown(1e3 * grid.width, 6)},
                                          {"read_back", fit_report(fit, lens.index)}}));
  } else {
    print_text(options.output + ": " + shown_text(1e3 * grid.width, 6) +
               " mm square; read back: " + fit_text(fit, lens.index) + "\n");
  }
  return 0;
}

}  // namespace

Action add_lens_from_sdf_command(CLI::App& lens) {
  auto options = std::make_shared<FromOptions>();
  CLI::App* command = lens.add_subcommand("from-sdf", "A lens file from a tabulated surface: SDF, HMF or XYZ");
  command->footer(
      "Example: vergence lens from-sdf front.sdf --index 1.6 --centre-thickness 2 --other-radius 119.25 --output "
      "lens.json\n"
      "The heights are fitted by a bicubic B-spline as smooth as their rounding allows; the report says how far it "
      "lies\n"
      "from them, and the power that the rounding leaves open.");
  command->add_option("FILE", options->input, "SDF (also within an OMA job), HMF or XYZ file, mm")->required();
  add_format_option(*command, options->sag);
  add_rows_option(*command, options->sag);
  add_surface_options(*command, options->sag, "Whose surface to take, where the file has both eyes'",
                      "Which surface it is: front or back (as the file says, else front)");
  add_smoothing_option(*command, options->sag);
  command->add_option("--lens", options->lens, "Lens file that gets the surface and keeps the rest");
  command->add_option("--other-radius", options->other_radius,
                      "The other surface: a radius in mm, or flat (no power on the axis)");
  command->add_option("--index", options->index, "Index of refraction (1.6)");
  command->add_option("--abbe", options->abbe, "Abbe number (41)");
  command->add_option("--centre-thickness", options->centre_thickness, "mm (2)");
  command->add_option("--diameter", options->diameter, "mm (what the table covers)");
  command->add_option("--output", options->output, "Lens file to write")->capture_default_str();
  command->add_flag("--json", options->json, "Report as JSON");
  return [options] {
    try {
      return from_sdf(*options);
    } catch (const std::invalid_argument& error) {
      throw InputError(options->input, "", std::string("makes no lens: ") + error.what());
    }
  };
}

Action add_lens_to_sdf_command(CLI::App& lens) {
  auto options = std::make_shared<ToOptions>();
  CLI::App* command = lens.add_subcommand("to-sdf", "A surface of a lens as a table: SDF, HMF or XYZ");
  command->footer(
      "Example: vergence lens to-sdf lens.json --surface back --count 141 --output back.sdf\n"
      "The report says what a reader of the file will find.");
  command->add_option("FILE", options->input, "Lens or spectacles file")->required();
  add_format_option(*command, options->sag);
  add_rows_option(*command, options->sag);
  add_surface_options(*command, options->sag, "Lens of a pair; also what the SDF record says (right)",
                      "front or back (front)");
  command->add_option("--count", options->count, "Columns and rows")->capture_default_str();
  command->add_option("--size", options->size, "Side of the square, mm (the diameter)");
  command->add_option("--decimals", options->decimals, "Of a millimetre")->capture_default_str();
  command->add_option("--output", options->output, "File to write")->capture_default_str();
  command->add_flag("--json", options->json, "Report as JSON");
  return [options] { return to_sdf(*options); };
}

}  // namespace app
