// vergence lens from-oma and to-oma: spectacles from job files (OMA / VCA), and back.
#include <memory>
#include <nlohmann/json.hpp>

#include "app/commands.hpp"
#include "app/lens_file_options.hpp"
#include "app/option_values.hpp"
#include "lenses/lens_io/json_text.hpp"
#include "lenses/lens_io/lens_io.hpp"
#include "lenses/lens_io/lens_or_spectacles.hpp"
#include "lenses/lens_io/oma_spectacles.hpp"
#include "tracking/input_error.hpp"

namespace app {
namespace {

using lenses::JobLens;
using lenses::SurfaceOrigin;
using nlohmann::ordered_json;
using tracking::InputError;

struct FromOptions {
  SagOptions sag;
  std::string input, output = "spectacles.json";
  double index = 1.498;
  bool json = false;
};

ordered_json origin_report(const SurfaceOrigin& origin, double index) {
  switch (origin.kind) {
    case SurfaceOrigin::Kind::tabulated:
      return {{"from", "SURFMT"}, {"fit", fit_report(*origin.fit, index)}};
    case SurfaceOrigin::Kind::radius:
      return {{"from", "radius"}};
    case SurfaceOrigin::Kind::prescription:
      break;
  }
  return {{"from", "prescription"}};
}

std::string origin_text(const SurfaceOrigin& origin, double index) {
  switch (origin.kind) {
    case SurfaceOrigin::Kind::tabulated:
      return "the job's table: " + fit_text(*origin.fit, index);
    case SurfaceOrigin::Kind::radius:
      return "the job's radius";
    case SurfaceOrigin::Kind::prescription:
      break;
  }
  return "made for the prescription";
}

ordered_json lens_report(const JobLens& made) {
  return {{"made", made.made},
          {"index", made.lens.index},
          {"centre_thickness_mm", shown(1e3 * made.lens.centre_thickness, 5)},
          {"diameter_mm", shown(1e3 * made.lens.diameter, 5)},
          {"front", origin_report(made.front, made.lens.index)},
          {"back", origin_report(made.back, made.lens.index)}};
}

std::string lens_text(const std::string& eye, const JobLens& made) {
  if (!made.made) return eye + ": not in the job; a plano lens stands in\n";
  return eye + ": index " + shown_text(made.lens.index) + ", " + shown_text(1e3 * made.lens.centre_thickness) +
         " mm thick, " + shown_text(1e3 * made.lens.diameter) + " mm across\n" + eye +
         " front: " + origin_text(made.front, made.lens.index) + "\n" + eye +
         " back: " + origin_text(made.back, made.lens.index) + "\n";
}

int from_oma(const FromOptions& options) {
  check_range("--index", options.index, 1.3, 2.2, "");
  const lenses::JobSpectacles made =
      lenses::spectacles_of(lenses::io::read_oma(options.input),
                    {.rows = options.sag.row_order(), .index = options.index, .fit = options.sag.fit_config()});
  write_text(options.output, to_json(made.spectacles));
  if (options.json) {
    print_text(lenses::io::document_text(
        {{"output", options.output}, {"right", lens_report(made.lens[0])}, {"left", lens_report(made.lens[1])}}));
  } else {
    print_text(lens_text("right", made.lens[0]) + lens_text("left", made.lens[1]));
  }
  return 0;
}

struct ToOptions {
  SagOptions sag;
  std::string input, job, wearer, output = "job.oma";
  int count = 71;
  bool json = false;
};

int to_oma(const ToOptions& options) {
  check_range("--count", options.count, 4, 300, "");
  const auto read = lenses::read_lens_or_spectacles(options.input);
  const auto* spectacles = std::get_if<lenses::Spectacles>(&read);
  if (spectacles == nullptr) {
    throw InputError(options.input, "right", "is missing; a job is of spectacles, with a right and a left lens");
  }
  lenses::JobWriting writing;
  writing.rows = options.sag.row_order();
  writing.grid = static_cast<std::size_t>(options.count);
  if (!options.job.empty()) writing.base = lenses::io::read_oma(options.job);
  if (!options.wearer.empty()) writing.pupillary_distance = lenses::read_wearer(options.wearer).pupillary_distance;
  const lenses::io::OmaJob job = job_of(*spectacles, options.input, writing);
  write_text(options.output, job.text());
  if (options.json) {
    print_text(lenses::io::document_text({{"output", options.output}, {"records", job.lines.size()}}));
  } else {
    print_text(options.output + ": " + std::to_string(job.lines.size()) + " records\n");
  }
  return 0;
}

}  // namespace

Action add_lens_from_oma_command(CLI::App& lens) {
  auto options = std::make_shared<FromOptions>();
  CLI::App* command = lens.add_subcommand("from-oma", "Spectacles from a job file: OMA / VCA (.oma .vca .lds .lms)");
  command->footer(
      "Example: vergence lens from-oma job.oma --output spectacles.json\n"
      "Surfaces that the job gives are taken (SURFMT, FRNT and BACK: beyond 20 a radius in mm, else dioptres for TIND "
      "or\n"
      "1.53); what it leaves open follows from its prescription.");
  command->add_option("FILE", options->input, "Job file")->required();
  add_rows_option(*command, options->sag);
  add_smoothing_option(*command, options->sag);
  command->add_option("--index", options->index, "Index of refraction where the job has no LIND")
      ->capture_default_str();
  command->add_option("--output", options->output, "Spectacles file to write")->capture_default_str();
  command->add_flag("--json", options->json, "Report as JSON");
  return [options] { return from_oma(*options); };
}

Action add_lens_to_oma_command(CLI::App& lens) {
  auto options = std::make_shared<ToOptions>();
  CLI::App* command = lens.add_subcommand("to-oma", "A job file (OMA / VCA) of spectacles");
  command->footer(
      "Example: vergence lens to-oma spectacles.json --job job.oma --output changed.oma\n"
      "With --job, records that still hold, and all that spectacles know nothing of, stay as they are.");
  command->add_option("FILE", options->input, "Spectacles file")->required();
  command->add_option("--job", options->job, "Job file to bring up to date");
  command->add_option("--wearer", options->wearer, "Wearer file, for the pupillary distances of a new job");
  add_rows_option(*command, options->sag);
  command->add_option("--count", options->count, "Columns and rows of tabulated surfaces")->capture_default_str();
  command->add_option("--output", options->output, "Job file to write")->capture_default_str();
  command->add_flag("--json", options->json, "Report as JSON");
  return [options] { return to_oma(*options); };
}

}  // namespace app
