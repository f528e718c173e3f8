// vergence lens progressive: a progressive lens from a few numbers.
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "app/commands.hpp"
#include "app/option_values.hpp"
#include "app/progressive_text.hpp"
#include "lenses/lens_io/lens_io.hpp"
#include "render/image/output_file.hpp"
#include "tracking/input_error.hpp"

namespace app {
namespace {

using lenses::ProgressiveConfig;
using tracking::InputError;

struct ProgressiveOptions {
  double add = 2.0, distance_power = 0.0;
  double corridor_mm = 14.0, inset_mm = 2.5, hardness = 0.5;
  double index = 1.6, abbe = 41.0;
  std::optional<double> base_curve, diameter_mm, thickness_mm;
  int grid = 50;
  std::string method = "variational", side = "right", output = "progressive.json";
  bool eye_side = false, json = false;
};

lenses::ProgressiveLensRequest request_of(const ProgressiveOptions& options) {
  constexpr double kMm = 1e-3;
  const auto metres = [](const std::optional<double>& mm) { return mm ? std::optional(kMm * *mm) : std::nullopt; };
  lenses::ProgressiveLensRequest request;
  ProgressiveConfig& surface = request.surface;
  surface.method =
      options.method == "closed-form" ? ProgressiveConfig::Method::closed_form : ProgressiveConfig::Method::variational;
  surface.face = options.eye_side ? ProgressiveConfig::Face::eye_side : ProgressiveConfig::Face::front;
  surface.side = options.side == "left" ? lenses::Side::left : lenses::Side::right;
  surface.corridor_length = kMm * options.corridor_mm;
  surface.inset = kMm * options.inset_mm;
  surface.hardness = options.hardness;
  surface.index = options.index;
  surface.grid = static_cast<std::size_t>(options.grid);
  request.sphere = options.distance_power;
  request.addition = options.add;
  request.base_curve = options.base_curve;
  request.diameter = metres(options.diameter_mm);
  request.centre_thickness = metres(options.thickness_mm);
  request.abbe = options.abbe;
  return request;
}

// The option behind a field of the request.
std::string option_of(const std::string& field) {
  constexpr std::array<std::pair<const char*, const char*>, 12> kOptions{{{"addition", "--add"},
                                                                          {"sphere", "--distance-power"},
                                                                          {"distance_power", "--distance-power"},
                                                                          {"corridor_length", "--corridor"},
                                                                          {"inset", "--inset"},
                                                                          {"hardness", "--hardness"},
                                                                          {"index", "--index"},
                                                                          {"abbe", "--abbe"},
                                                                          {"base_curve", "--base-curve"},
                                                                          {"diameter", "--diameter"},
                                                                          {"centre_thickness", "--centre-thickness"},
                                                                          {"grid", "--grid"}}};
  for (const auto& [name, option] : kOptions) {
    if (field == name) return option;
  }
  return field;
}

lenses::DesignProgress progress_line() {
  if (::isatty(STDERR_FILENO) == 0) return {};
  return [](double done) {
    if (done < 1.0) {
      std::fprintf(stderr, "\rdesigning %3.0f %% ", 100.0 * done);
    } else {
      std::fprintf(stderr, "\r%-20s\r", "");
    }
  };
}

int design_progressive(const ProgressiveOptions& options) {
  check_range("--grid", options.grid, 24, 100, "control points");
  ProgressiveRun run{options.output, request_of(options), {}, 0.0};
  const auto start = std::chrono::steady_clock::now();
  try {
    run.made = lenses::make_progressive_lens(run.request, progress_line());
  } catch (const InputError& error) {
    throw InputError(option_of(error.field()), "", error.reason());
  }
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const std::string file = lenses::to_json(run.made.lens);
  render::write_file(options.output, std::as_bytes(std::span(file)));
  std::cout << (options.json ? progressive_json(run) : progressive_table(run));
  std::cout.flush();
  if (!std::cout) {
    throw std::runtime_error("standard output: cannot be written");
  }
  return 0;
}

}  // namespace

Action add_lens_progressive_command(CLI::App& lens) {
  auto options = std::make_shared<ProgressiveOptions>();
  CLI::App* command = lens.add_subcommand("progressive", "Design a progressive lens");
  command->footer(
      "Example:\n"
      "  vergence lens progressive --add 2.25 --distance-power -1.5 --corridor 13 --hardness 0.3 --output right.json\n"
      "Cylinder and power of the report are of the progressive surface alone; vergence measure shows the whole lens.");
  command->add_option("--add", options->add, "Addition, D, 0.75 to 3.5")->capture_default_str();
  command->add_option("--distance-power", options->distance_power, "Of the lens, D")->capture_default_str();
  command->add_option("--corridor", options->corridor_mm, "Fitting cross down to the near point, mm, 8 to 18")
      ->capture_default_str();
  command->add_option("--inset", options->inset_mm, "Near point toward the nose, mm, 0 to 5")->capture_default_str();
  command
      ->add_option("--hardness", options->hardness,
                   "0: soft, little cylinder, spread wide; 1: hard, wide clear zones, more cylinder beside them")
      ->capture_default_str();
  command->add_flag("--eye-side", options->eye_side, "The progressive surface on the eye side instead of the front");
  command->add_option("--side", options->side, "Eye: right or left")
      ->check(CLI::IsMember({"right", "left"}))
      ->capture_default_str();
  command->add_option("--index", options->index, "Refractive index (d line)")->capture_default_str();
  command->add_option("--abbe", options->abbe, "Abbe number")->capture_default_str();
  command->add_option("--base-curve", options->base_curve, "Front power at the distance point, D; by Vogel's rule");
  command->add_option("--diameter", options->diameter_mm, "mm; 65, or what the curves allow");
  command->add_option("--centre-thickness", options->thickness_mm, "mm; what 1.2 mm there and 1 mm at the edge need");
  command->add_option("--grid", options->grid, "Control points along each axis, 24 to 100")->capture_default_str();
  command
      ->add_option("--method", options->method, "variational, or closed-form: the sphere family, whatever the hardness")
      ->check(CLI::IsMember({"variational", "closed-form"}))
      ->capture_default_str();
  command->add_option("--output", options->output, "Lens file to write")->capture_default_str();
  command->add_flag("--json", options->json, "The report as JSON");
  return [options] { return design_progressive(*options); };
}

}  // namespace app
