// vergence tradeoff: what accuracy costs in time.
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <memory>
#include <sstream>

#include "app/commands.hpp"
#include "app/option_values.hpp"
#include "app/report/output_folder.hpp"
#include "app/scene_options.hpp"
#include "app/tradeoff/tradeoff_advice.hpp"
#include "app/tradeoff/tradeoff_chart.hpp"
#include "app/tradeoff/tradeoff_page.hpp"
#include "app/tradeoff_run.hpp"
#include "render/image/png.hpp"
#include "tracking/input_error.hpp"

namespace app {
namespace {

using tracking::InputError;

struct TradeoffOptions {
  SceneOptions scene;
  PictureOptions picture;
  std::string mode = "all", settings = "all", size;
  std::optional<int> reference_samples, rounds;
  std::optional<double> target_error;
  std::uint32_t seed = 0;
  std::string device, output;
  bool quick = false, json = false;
};

// Sized for ten minutes and for one on two cores of a processor that draws the pictures itself.
struct Effort {
  const char* size;
  int reference_samples, rounds;
  double most_seconds;  // of a setting
};
constexpr Effort kFull{"384x384", 1024, 5, 6.0}, kQuick{"160x160", 256, 3, 1.0};
constexpr int kMostSamples = 65536;

std::string mode_of(const render::Rung& rung) {
  const render::Mode mode = rung.mode.value_or(render::Mode::adof);
  return mode == render::Mode::pinhole ? "pinhole"
         : mode == render::Mode::adof  ? "adof"
         : render::is_map(mode)        ? "power"
                                       : "dof";
}

bool is_named(const std::string& list, std::string_view name) {
  std::istringstream words(list);
  for (std::string word; std::getline(words, word, ',');) {
    if (word == name) {
      return true;
    }
  }
  return false;
}

void check_settings(const std::string& list) {
  if (list == "all") {
    return;
  }
  std::istringstream words(list + ",");
  for (std::string word; std::getline(words, word, ',');) {
    if (render::find_rung(word) == nullptr) {
      std::string names;
      for (const render::Rung& rung : render::ladder()) {
        names += std::string(rung.name) + ", ";
      }
      throw InputError("--settings", "", "'" + word + "' is none of " + names + "or all");
    }
  }
}

// Distributed rays as many as the reference's own say nothing.
std::vector<render::Rung> chosen_rungs(const TradeoffOptions& options, int reference_samples) {
  check_settings(options.settings);
  std::vector<render::Rung> rungs;
  for (const render::Rung& rung : render::ladder()) {
    const bool asked = options.settings == "all" ? rung.samples.value_or(1) < reference_samples
                                                 : is_named(options.settings, rung.name);
    if (asked && (options.mode == "all" || options.mode == mode_of(rung))) {
      rungs.push_back(rung);
    }
  }
  if (rungs.empty()) {
    throw InputError("--settings", "", "'" + options.settings + "' and --mode " + options.mode + " leave no setting");
  }
  return rungs;
}

TradeoffConfig config_of(const TradeoffOptions& options) {
  const Effort& effort = options.quick ? kQuick : kFull;
  TradeoffConfig config;
  config.scene = options.scene;
  config.scene.size = options.size.empty() ? effort.size : options.size;
  config.reference_samples = options.reference_samples.value_or(effort.reference_samples);
  config.rounds = options.rounds.value_or(effort.rounds);
  check_range("--reference-samples", config.reference_samples, 2, kMostSamples, "");
  check_range("--rounds", config.rounds, 1, 1000, "");
  if (options.target_error) {
    check_range("--target-error", *options.target_error, 1e-6, 1.0, "");
  }
  check_picture_options(options.picture);
  config.rungs = chosen_rungs(options, config.reference_samples);
  config.accuracy = options.picture.accuracy;
  config.threshold_px = options.picture.threshold();
  config.exposure = options.picture.exposure;
  config.seed = options.seed;
  config.most_seconds = effort.most_seconds;
  config.cache = reference_folder();
  config.target_rmse = options.target_error;
  config.device = options.device;
  return config;
}

TradeoffProgress progress_line() {
  if (::isatty(STDERR_FILENO) == 0) {
    return {};
  }
  return [](const std::string& what, int done, int of) {
    std::fprintf(stderr, "\r%-40.40s %4d of %4d ", what.c_str(), done, of);
  };
}

// The page last: what it shows is there.
void write_report(const std::filesystem::path& folder, const TradeoffResult& result) {
  const TradeoffReport& report = result.report;
  const Drawing chart = tradeoff_chart(report);
  render::write_png(folder / kReferenceFile, result.reference);
  for (std::size_t i = 0; i < report.rows.size(); ++i) {
    render::write_png(folder / picture_file(report.rows[i]), result.pictures[i]);
    if (report.rows[i].rmse) {
      render::write_png(folder / difference_file(report.rows[i]),
                        difference_image(result.pictures[i], result.reference));
    }
  }
  write_text(folder / "tradeoff.csv", tradeoff_csv(report.rows));
  write_text(folder / "tradeoff.svg", to_svg(chart));
  render::write_png(folder / "tradeoff.png", to_image(chart));
  write_text(folder / "report.html", tradeoff_page(report));
}

int tradeoff(TradeoffOptions options) {
  const TradeoffConfig config = config_of(options);
  const std::string scene_file = config.scene.scene.empty() ? built_in_scene().string() : config.scene.scene;
  std::optional<OutputFolder> folder;
  if (!options.output.empty()) {
    folder.emplace("--output", options.output);
  }
  const render::Scene scene = render::read_gltf(scene_file);
  const TradeoffProgress progress = progress_line();
  const TradeoffResult result = run_tradeoff(config, scene, progress);
  if (progress) {
    std::fprintf(stderr, "\r%-79s\r", "");
  }
  if (folder) {
    write_report(folder->path(), result);
  }
  std::cout << (options.json ? tradeoff_json(result.report) : tradeoff_table(result.report)) << std::flush;
  if (!std::cout) {
    throw std::runtime_error("standard output: cannot be written");
  }
  return 0;
}

void add_effort_options(CLI::App& command, TradeoffOptions& options) {
  command.add_flag("--quick", options.quick,
                   "Smaller pictures, fewer rounds and samples: within a minute on two cores");
  command.add_option("--size", options.size, "WxH in pixels of each eye's picture [384x384, with --quick 160x160]");
  command.add_option("--reference-samples", options.reference_samples,
                     "Rays a pixel of the reference [1024, with --quick 256]");
  command.add_option("--rounds", options.rounds,
                     "How often each setting is timed; slow ones less often [5, with --quick 3]");
}

}  // namespace

Action add_tradeoff_command(CLI::App& program) {
  auto options = std::make_shared<TradeoffOptions>();
  options->scene.eye = "right";
  options->scene.fov_deg = 30.0;  // so that 384 pixels are 12 a degree, and blurs span some of them
  CLI::App* command = program.add_subcommand("tradeoff", "What accuracy costs in time: every setting of the ladder");
  command->footer(
      "Example:\n"
      "  vergence tradeoff --wearer assets/wearers/presbyopia.json \\\n"
      "    --spectacles assets/spectacles/presbyopia_bspline_sphere.json --look-at near_card --output report\n"
      "Each setting that --accuracy knows is drawn and timed in turns, and held against a converged picture of\n"
      "distributed rays, which is kept between runs. Writes tradeoff.csv, a picture of error against time (svg, png)\n"
      "and report.html with every setting's picture.");
  add_scene_options(*command, options->scene);
  command->add_option("--eye", options->scene.eye, "left, right, or both (left | right side by side)")
      ->check(CLI::IsMember({"left", "right", "both"}))
      ->capture_default_str();
  command->add_option("--mode", options->mode, "all, or only the settings of one mode")
      ->check(CLI::IsMember({"all", "pinhole", "adof", "dof", "power"}))
      ->capture_default_str();
  command->add_option("--settings", options->settings, "all, or a list of what --accuracy takes: standard,dof-16")
      ->capture_default_str();
  add_picture_options(*command, options->picture);
  add_effort_options(*command, *options);
  command->add_option("--target-error", options->target_error,
                      "RMS error of display values, 0 to 1, that the samples of mode dof are\ncounted for [that of "
                      "--accuracy]");
  command->add_option("--seed", options->seed, "Of the sampling pattern (dof)")->capture_default_str();
  command->add_option("--output", options->output, "Folder for tradeoff.csv, the picture (svg, png) and report.html");
  command->add_flag("--json", options->json, "Print the rows as JSON");
  command->add_option("--device", options->device, "GPU by name or index [the first discrete, else any]");
  return [options] { return tradeoff(*options); };
}

}  // namespace app
