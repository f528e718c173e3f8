// vergence measure: a lens as a lensmeter reads it and as it is worn, judged by the tolerances of a standard.
#include <unistd.h>

#include <cstdio>
#include <iostream>
#include <memory>
#include <numbers>

#include "app/commands.hpp"
#include "app/measure/measure_files.hpp"
#include "app/measure/measure_page.hpp"
#include "app/measure/measure_pictures.hpp"
#include "app/measure/measure_report.hpp"
#include "app/option_values.hpp"
#include "app/prism_option.hpp"
#include "app/report/output_folder.hpp"
#include "lenses/lens_io/lens_io.hpp"
#include "render/image/png.hpp"
#include "tracking/input_error.hpp"

namespace app {
namespace {

using tracking::InputError;

constexpr double kRadians = std::numbers::pi / 180.0;

struct MeasureOptions {
  std::string lens, spectacles, side = "right", wearer, output;
  std::string standard = lenses::tolerance_standards().front().name;
  std::string lens_class = "auto", form = "minus", view = "wearer";
  int grid = 121;
  double working_distance = 0.4, field_deg = 40.0;
  std::optional<double> sphere, cylinder, axis, add;
  std::vector<std::string> prism;
  bool json = false;
};

struct Subject {
  std::string source;  // as a report names it
  std::string file, field;
  lenses::Lens lens;
  std::optional<lenses::Lens> other;  // of the pair
};

lenses::Side side_of(const MeasureOptions& options) {
  return options.side == "left" ? lenses::Side::left : lenses::Side::right;
}

Subject read_subject(const MeasureOptions& options) {
  if (options.lens.empty() == options.spectacles.empty()) {
    throw InputError("--lens", "", "is missing; a lens file, or a pair by --spectacles, is needed");
  }
  if (!options.lens.empty()) {
    return {options.lens, options.lens, "", lenses::read_lens(options.lens), std::nullopt};
  }
  const lenses::Spectacles pair = lenses::read_spectacles(options.spectacles);
  const auto side = static_cast<std::size_t>(side_of(options));
  return {options.spectacles + ", " + options.side, options.spectacles, options.side, pair.lens[side],
          pair.lens[1 - side]};
}

std::optional<lenses::Order> order_by_hand(const MeasureOptions& options) {
  if (!options.sphere && !options.cylinder && !options.axis && !options.add && options.prism.empty()) {
    return std::nullopt;
  }
  lenses::Order order;
  order.ordered.sphere = options.sphere.value_or(0.0);
  order.ordered.cylinder = options.cylinder.value_or(0.0);
  order.ordered.axis = options.axis.value_or(180.0) * kRadians;
  order.ordered.addition = options.add.value_or(0.0);
  check_range("--sphere", order.ordered.sphere, -60.0, 60.0, "D");
  check_range("--cylinder", order.ordered.cylinder, -30.0, 30.0, "D");
  check_range("--axis", options.axis.value_or(180.0), 0.0, 180.0, "degrees (TABO)");
  check_range("--add", order.ordered.addition, 0.0, 10.0, "D");
  if (options.cylinder && *options.cylinder != 0.0 && !options.axis) {
    throw InputError("--axis", "", "is missing; a cylinder needs its axis, 0 to 180 degrees (TABO)");
  }
  for (const std::string& text : options.prism) {
    order.ordered.prism.push_back(prism_of("--prism", text, side_of(options)));
    check_range("--prism", order.ordered.prism.back().magnitude, 0.0, 40.0, "pd");
  }
  return order;
}

const lenses::ToleranceStandard& standard_of(const std::string& name) {
  if (const lenses::ToleranceStandard* found = lenses::find_standard(name)) {
    return *found;
  }
  std::string known;
  for (const lenses::ToleranceStandard& standard : lenses::tolerance_standards()) {
    known += (known.empty() ? "" : ", ") + standard.name;
  }
  throw InputError("--standard", "", "'" + name + "' is not known; " + known);
}

lenses::LensClass class_of(const MeasureOptions& options, const lenses::Lens& lens) {
  for (const auto known :
       {lenses::LensClass::single_vision, lenses::LensClass::multifocal, lenses::LensClass::progressive}) {
    if (options.lens_class == name(known)) {
      return known;
    }
  }
  return lenses::lens_class_of(lens);
}

lenses::Progress progress_of(const std::string& what) {
  if (::isatty(STDERR_FILENO) == 0) {
    return {};
  }
  return [what](double done) { std::fprintf(stderr, "\r%s %3.0f %% ", what.c_str(), 100.0 * done); };
}

void write_report(const std::filesystem::path& folder, const MeasureOptions& options, const MeasureReport& report,
                  const lenses::Eye& eye) {
  const auto points = static_cast<std::size_t>(options.grid);
  const lenses::LensMap lens_map =
      lenses::lens_map(report.lens, lenses::Lensmeter(report.lens), points, progress_of("over the lens"));
  const lenses::WornMap worn_map =
      lenses::worn_map(report.lens, report.side, eye, {options.field_deg * kRadians, points, options.working_distance},
                       progress_of("as worn"));
  if (::isatty(STDERR_FILENO) != 0) {
    std::fprintf(stderr, "\r%-40s\r", "");
  }
  const std::vector<NamedPicture> pictures = measure_pictures(
      report, lens_map, worn_map, eye, options.view == "examiner" ? ViewedBy::examiner : ViewedBy::wearer);
  write_text(folder / "readings.csv", readings_csv(report));
  if (report.verdict) {
    write_text(folder / "verdict.csv", verdict_csv(*report.verdict));
  }
  write_text(folder / "lens_map.csv", lens_map_csv(lens_map, report.form));
  write_text(folder / "worn_map.csv", worn_map_csv(worn_map, report));
  for (const NamedPicture& picture : pictures) {
    render::write_png(folder / picture.file, picture.image);
  }
  const WornSetting setting{options.working_distance, worn_map.far_pitch, worn_map.near_pitch,
                            report.lens.fit.vertex_distance + eye.centre_of_rotation_depth};
  write_text(folder / "report.html", measure_page(report, setting, pictures));
}

int measure(const MeasureOptions& options) {
  check_range("--grid", options.grid, 11, 801, "samples");
  check_range("--working-distance", options.working_distance, 0.1, 100.0, "m");
  check_range("--field", options.field_deg, 5.0, 60.0, "degrees");
  const lenses::ToleranceStandard& standard = standard_of(options.standard);
  const std::optional<lenses::Order> by_hand = order_by_hand(options);
  Subject subject = read_subject(options);
  const lenses::Eye eye = options.wearer.empty()
                              ? lenses::Eye{}
                              : lenses::read_wearer(options.wearer).eye[static_cast<std::size_t>(side_of(options))];
  if (by_hand) {
    subject.lens.order = by_hand;
  }
  std::optional<OutputFolder> folder;
  if (!options.output.empty()) {
    folder.emplace("--output", options.output);
  }
  try {
    const MeasureReport report =
        measure_lens(subject.source, subject.lens, side_of(options),
                     options.form == "plus" ? lenses::CylinderForm::plus : lenses::CylinderForm::minus,
                     class_of(options, subject.lens), standard, by_hand ? std::nullopt : subject.other);
    if (folder) {
      write_report(folder->path(), options, report, eye);
    }
    std::cout << (options.json ? measure_json(report) : measure_table(report));
  } catch (const std::invalid_argument& error) {
    throw InputError(subject.file, subject.field, error.what());
  }
  std::cout.flush();
  if (!std::cout) {
    throw std::runtime_error("standard output: cannot be written");
  }
  return 0;
}

void add_order_options(CLI::App& command, MeasureOptions& options) {
  command.add_option("--sphere", options.sphere, "Ordered sphere, D; one of these replaces the lens file's order");
  command.add_option("--cylinder", options.cylinder, "Ordered cylinder, D, either sign");
  command.add_option("--axis", options.axis, "Its axis, TABO degrees");
  command.add_option("--add", options.add, "Ordered addition, D");
  command.add_option("--prism", options.prism,
                     "Ordered prism, M@B: prism dioptres and base (0-360 TABO, up, down, in, out); may be repeated");
}

}  // namespace

Action add_measure_command(CLI::App& program) {
  auto options = std::make_shared<MeasureOptions>();
  CLI::App* command =
      program.add_subcommand("measure", "One lens as a lensmeter reads it and as worn, with maps and a verdict");
  command->footer(
      "Example:\n"
      "  vergence measure --lens assets/lenses/progressive_add200_right.json --sphere 0 --add 2 --output out/lens\n"
      "The lensmeter's beam is normal to the surface on its stop; additions are read from the side that carries them.\n"
      "The verdict compares with the order's compensated (verification) power where the lens file has one, else with\n"
      "what was ordered. --output writes readings.csv, verdict.csv, lens_map.csv, worn_map.csv, maps as PNG and\n"
      "report.html.");
  auto* lens = command->add_option("--lens", options->lens, "Lens file");
  command->add_option("--spectacles", options->spectacles, "Spectacles file; measures one --side of the pair")
      ->excludes(lens);
  command->add_option("--side", options->side, "right or left: which lens, and where the nose is")
      ->check(CLI::IsMember({"right", "left"}))
      ->capture_default_str();
  command->add_option("--output", options->output, "Folder for csv, maps (png) and report.html");
  command->add_option("--standard", options->standard, "Standard whose tolerances judge the lens")
      ->capture_default_str();
  command
      ->add_option("--class", options->lens_class,
                   "Which of its tolerances: auto, single_vision, multifocal, progressive")
      ->check(CLI::IsMember({"auto", "single_vision", "multifocal", "progressive"}))
      ->capture_default_str();
  add_order_options(*command, *options);
  command->add_option("--cylinder-form", options->form, "minus or plus cylinders in every answer")
      ->check(CLI::IsMember({"minus", "plus"}))
      ->capture_default_str();
  command->add_option("--wearer", options->wearer, "Wearer file, for where the eye turns in the as-worn maps");
  command
      ->add_option("--working-distance", options->working_distance,
                   "Of the near gaze, m; infinite at the fitting cross and above")
      ->capture_default_str();
  command->add_option("--field", options->field_deg, "Gaze of the as-worn maps to either side, degrees")
      ->capture_default_str();
  command->add_option("--grid", options->grid, "Samples of a map each way")->capture_default_str();
  command->add_option("--view", options->view, "Pictures as the wearer or as the examiner sees the lens")
      ->check(CLI::IsMember({"wearer", "examiner"}))
      ->capture_default_str();
  command->add_flag("--json", options->json, "Print readings and verdict as JSON");
  return [options] { return measure(*options); };
}

}  // namespace app
