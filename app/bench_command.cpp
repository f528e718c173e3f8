// vergence bench: milliseconds a stage and frames a second, the paper's Table 1 among them, or the paper's figures.
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <sstream>

#include "app/bench/bench_chart.hpp"
#include "app/bench/bench_report.hpp"
#include "app/bench_figures.hpp"
#include "app/bench_run.hpp"
#include "app/bench_vr.hpp"
#include "app/commands.hpp"
#include "app/option_values.hpp"
#include "app/report/output_folder.hpp"
#include "app/scene_options.hpp"
#include "render/image/png.hpp"
#include "render/ladder.hpp"
#include "tracking/input_error.hpp"

namespace app {
namespace {

using tracking::InputError;

struct BenchOptions {
  SceneOptions scene;
  PictureOptions picture;
  std::string lenses = "all", modes = "all", sizes = "512", shading = "both";
  int rounds = 3;
  std::uint32_t seed = 0;
  std::string traversal = "automatic", device, output, figures;
  bool json = false;
  bool vr = false;
  int frames = 120;  // of each row of --vr
};

// What the shared --mode calls these.
std::string bench_mode(const std::string& name) {
  return name == "pinhole" ? "pin" : name == "power" ? "vis" : name;
}

// The names in a list such as "none,bspline/sphere", in the order of `known`; "all" is every one.
std::vector<std::string> chosen(const std::string& option, const std::string& text, std::span<const std::string> known,
                                const std::string& all, std::span<const std::string> more = {}) {
  if (text == all) {
    return {known.begin(), known.end()};
  }
  std::vector<std::string> ordered(known.begin(), known.end());
  ordered.insert(ordered.end(), more.begin(), more.end());
  std::set<std::string> wanted;
  std::istringstream words(text + ",");
  std::string names;
  for (const std::string& name : ordered) {
    names += name + ", ";
  }
  for (std::string word; std::getline(words, word, ',');) {
    const std::string name = option == "--mode" ? bench_mode(word) : word;
    if (std::ranges::find(ordered, name) == ordered.end()) {
      throw InputError(option, "", "'" + word + "' is none of " + names + "or " + all);
    }
    wanted.insert(name);
  }
  std::erase_if(ordered, [&](const std::string& name) { return !wanted.contains(name); });
  return ordered;
}

std::vector<int> sizes_of(const std::string& text) {
  std::vector<int> sizes;
  const auto commas = static_cast<std::size_t>(std::ranges::count(text, ','));
  for (const double size :
       numbers_of("--size", text, commas + 1, "a list of pixels along each side, such as 512,1024")) {
    check_range("--size", size, 1.0, 16384.0, "px");
    if (size != static_cast<double>(static_cast<int>(size))) {
      throw InputError("--size", "", "'" + text + "' must be whole pixels, such as 512,1024");
    }
    sizes.push_back(static_cast<int>(size));
  }
  std::ranges::sort(sizes);
  const auto repeated = std::ranges::unique(sizes);
  sizes.erase(repeated.begin(), repeated.end());
  return sizes;
}

std::string spectacles_of(const std::string& lens) {
  if (lens == "none") {
    return "none";
  }
  const std::string folder = lens.starts_with("bspline/") ? "spectacles/presbyopia_" : "bench/";
  std::string name = lens;
  std::ranges::replace(name, '/', '_');
  return built_in_asset(folder + name + ".json").string();
}

std::vector<BenchLens> lenses_of(const BenchOptions& options) {
  std::vector<BenchLens> lenses;
  for (const std::string& lens : chosen("--lens", options.lenses, kBenchLenses, "all", std::span(&kFineNetLens, 1))) {
    lenses.push_back({lens, spectacles_of(lens)});
  }
  for (const std::string& pair : {options.scene.spectacles, options.scene.compare}) {
    if (!pair.empty() && std::ranges::find(lenses, pair, &BenchLens::name) == lenses.end()) {
      lenses.push_back({pair, pair});
    }
  }
  return lenses;
}

BenchConfig config_of(const BenchOptions& options) {
  BenchConfig config;
  config.lenses = lenses_of(options);
  config.modes = chosen("--mode", options.modes, kBenchModes, "all");
  config.shadings = chosen("--shading", options.shading, kBenchShadings, "both");
  config.sizes = sizes_of(options.sizes);
  config.rounds = options.rounds;
  config.scene = options.scene;
  config.accuracy = render::find_rung(options.picture.accuracy)->accuracy;
  config.threshold_px = options.picture.threshold();
  config.exposure = options.picture.exposure;
  config.seed = options.seed;
  config.device = options.device;
  config.traversal = options.traversal == "tile"        ? render::Traversal::tile
                     : options.traversal == "per_ray"   ? render::Traversal::per_ray
                     : options.traversal == "ray_query" ? render::Traversal::ray_query
                                                        : render::Traversal::automatic;
  return config;
}

BenchProgress progress_line() {
  if (::isatty(STDERR_FILENO) == 0) {
    return {};
  }
  return [](const BenchRow& row, int round) {
    std::fprintf(stderr, "\r%dx%d round %d: %-40.40s %-4s %-4s ", row.size, row.size, round, row.lens.c_str(),
                 row.mode.c_str(), row.shading.c_str());
  };
}

// An option that makes something else of the command goes with these only.
void refuse_beside(const CLI::App& command, const std::string& special, const std::set<std::string>& allowed) {
  std::string names;
  for (const std::string& name : allowed) {
    names += (names.empty() ? "" : ", ") + name;
  }
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option->get_name();
    if (option->count() > 0 && name != special && !allowed.contains(name)) {
      throw InputError(name, "", "cannot be given together with " + special + ", which takes only " + names);
    }
  }
}

// Figures have their own eyes, lenses and sizes.
void refuse_beside_figures(const CLI::App& command) {
  refuse_beside(command, "--figures", {"--scene", "--device"});
}

// The runtime has its own idea of eyes; a session times each frame once, and chooses how rays find the scene by itself.
void refuse_beside_vr(const CLI::App& command) {
  refuse_beside(command, "--vr",
                {"--scene", "--wearer", "--spectacles", "--compare", "--viewing", "--headset", "--lens", "--mode",
                 "--size", "--accuracy", "--threshold", "--exposure", "--frames", "--device", "--json"});
}

void measure_in_headset(const BenchOptions& options, bool all_modes, bool own_size) {
  BenchVrConfig config;
  config.lenses = lenses_of(options);
  config.modes = all_modes ? std::vector<std::string>{"adof"} : chosen("--mode", options.modes, kBenchModes, "all");
  config.session.scene = options.scene;
  config.session.scene.compare.clear();
  config.session.picture = options.picture;
  config.session.samples = 1;  // dof
  config.session.device = options.device;
  config.session.frames = options.frames;
  if (own_size) {
    const std::vector<int> sizes = sizes_of(options.sizes);
    if (sizes.size() != 1) {
      throw InputError("--size", "", "'" + options.sizes + "' must be one size for --vr, such as 512");
    }
    config.session.size = std::to_string(sizes[0]) + "x" + std::to_string(sizes[0]);
  }
  const bool is_watched = ::isatty(STDERR_FILENO) != 0;
  const auto rows = run_bench_vr(config, [&](const BenchVrRow& row) {
    if (is_watched) {
      std::fprintf(stderr, "%s, %s\n", row.lens.c_str(), row.mode.c_str());
    }
  });
  std::cout << (options.json ? bench_vr_json(rows) : bench_vr_table(rows));
}

void draw_figures(const BenchOptions& options) {
  const OutputFolder folder("--figures", options.figures);
  const bool is_watched = ::isatty(STDERR_FILENO) != 0;
  const auto progress = [&](const std::string& name) {
    if (is_watched) {
      std::fprintf(stderr, "%s\n", name.c_str());
    }
  };
  for (const std::string& file : write_figures({folder.path(), options.scene.scene, options.device}, progress)) {
    std::cout << file << '\n';
  }
}

void measure(const BenchOptions& options) {
  const BenchConfig config = config_of(options);
  std::optional<OutputFolder> folder;
  if (!options.output.empty()) {
    folder.emplace("--output", options.output);
  }
  const render::Scene scene = render::read_gltf(options.scene.scene);
  const BenchProgress progress = progress_line();
  const BenchReport report = run_bench(config, scene, progress);
  if (progress) {
    std::fprintf(stderr, "\r%-79s\r", "");
  }
  if (folder) {
    write_text(folder->path() / "bench.csv", rows_csv(report.rows, report.peers));
    write_text(folder->path() / "bench.svg", to_svg(bench_chart(report)));
    render::write_png(folder->path() / "bench.png", to_image(bench_chart(report)));
    write_text(folder->path() / "report.html", bench_page(report));
  }
  std::cout << (options.json ? rows_json(report.rows, report.peers) : bench_table(report));
}

int bench(BenchOptions options, const CLI::App& command) {
  check_range("--rounds", options.rounds, 1, 1000, "");
  check_range("--frames", options.frames, 2, 1'000'000, "");
  check_picture_options(options.picture);
  if (options.scene.scene.empty()) {
    const std::filesystem::path cars = fetched_car_scene();
    options.scene.scene = (cars.empty() ? built_in_scene() : cars).string();
  }
  if (!options.figures.empty()) {
    draw_figures(options);
  } else if (options.vr) {
    measure_in_headset(options, command.count("--mode") == 0, command.count("--size") > 0);
  } else {
    measure(options);
  }
  std::cout.flush();
  if (!std::cout) {
    throw std::runtime_error("standard output: cannot be written");
  }
  return 0;
}

}  // namespace

Action add_bench_command(CLI::App& program) {
  auto options = std::make_shared<BenchOptions>();
  options->scene.spectacles.clear();
  CLI::App* command = program.add_subcommand("bench", "Milliseconds a stage, the paper's Table 1 among them");
  command->footer(
      "Example:\n"
      "  vergence bench --lens none,bspline/sphere --mode adof --size 512,1024,2048 --output report\n"
      "Rows that are called bare are drawn as the paper did, in base colours with one light, no shadow rays and one "
      "ray a\n"
      "pixel, and stand beside its GTX 480; full rows are what render draws. One eye, the right. Frames take turns "
      "over several\n"
      "rounds. Embree's packets of 16 rays trace the same scene rays in the same run, on all threads of the CPU.");
  add_scene_options(
      *command, options->scene,
      {.scene = "FILE.gltf or FILE.glb [the cars of assets/fetch_scenes.sh if fetched, else the reading room]",
       .spectacles = "Spectacles file, or none: timed beside the lenses of --lens",
       .compare = "Another pair that is timed beside them"});
  add_picture_options(*command, options->picture);
  command
      ->add_option(
          "--lens", options->lenses,
          "all, or some of none,sphere/sphere,sphere/torus,bspline/sphere,bspline/torus; or bspline100/sphere,\n"
          "the front of bspline/sphere with 100 x 100 control points instead of 50 x 50")
      ->capture_default_str();
  command
      ->add_option("--mode", options->modes,
                   "all, or some of adof (approximate defocus), vis (power map), pin (pinhole), dof (one sample)")
      ->capture_default_str();
  command->add_option("--size", options->sizes, "Pixels along each side, a list: 512,1024,2048")->capture_default_str();
  command
      ->add_option("--shading", options->shading,
                   "bare (as the paper), full, or both: bare rows of every mode,\nfull ones of adof")
      ->capture_default_str();
  command
      ->add_option(
          "--traversal", options->traversal,
          "How chief rays find the scene: automatic (the fastest by a measurement\nthat is kept), per_ray, tile, or "
          "ray_query where the device has\nVK_KHR_ray_query: correct on Mesa 25's lavapipe, where it is slow;\n"
          "unproven on other devices")
      ->check(CLI::IsMember({"automatic", "per_ray", "tile", "ray_query"}))
      ->capture_default_str();
  command->add_option("--rounds", options->rounds, "How often each frame is timed")->capture_default_str();
  command->add_option("--seed", options->seed, "Of the sampling pattern (dof)")->capture_default_str();
  command->add_option("--output", options->output, "Folder for bench.csv, a chart (svg, png) and report.html");
  command->add_flag("--json", options->json, "Print the rows as JSON");
  command->add_option(
      "--figures", options->figures,
      "Folder for the paper's Figures 1, 4, 5 and 6; measures nothing, and takes --scene and --device only");
  command->add_option("--device", options->device, "GPU by name or index [the first discrete, else any]");
  command->add_flag(
      "--vr", options->vr,
      "In the headset instead, through OpenXR: from xrWaitFrame to the submission of the picture, part by\n"
      "part, a session a lens; adof at the runtime's size if --mode and --size say nothing else");
  command->add_option("--frames", options->frames, "Frames of each session of --vr")->capture_default_str();
  return [options, command] {
    if (!options->figures.empty()) {
      refuse_beside_figures(*command);
    } else if (options->vr) {
      refuse_beside_vr(*command);
    } else if (command->count("--frames") > 0) {
      throw InputError("--frames", "", "is for --vr only; --rounds says how often a frame is timed");
    }
    return bench(*options, *command);
  };
}

}  // namespace app
