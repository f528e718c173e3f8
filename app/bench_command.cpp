// vergence bench: milliseconds a stage and frames a second, the paper's Table 1 among them, or the paper's figures.
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <sstream>
#include <thread>

#include "app/bench/bench_chart.hpp"
#include "app/bench/bench_report.hpp"
#include "app/bench_figures.hpp"
#include "app/commands.hpp"
#include "app/device.hpp"
#include "app/render_setup.hpp"
#include "app/report/output_folder.hpp"
#include "render/chief_rays.hpp"
#include "render/device_speed.hpp"
#include "render/image/png.hpp"
#include "render/renderer.hpp"
#include "tracking/input_error.hpp"

namespace app {
namespace {

using tracking::InputError;

struct BenchOptions {
  SceneOptions scene;
  std::string lenses = "all", modes = "all", sizes = "512", shading = "both";
  int rounds = 3;
  double threshold_px = 0.5;
  bool all_effects = false;
  std::string device, output, figures;
  bool json = false;
};

// The names in a list such as "none,bspline/sphere", in the order of `known`; "all" is every one.
template <std::size_t n>
std::vector<std::string> chosen(const std::string& option, const std::string& text,
                                const std::array<std::string, n>& known, const std::string& all) {
  if (text == all) {
    return {known.begin(), known.end()};
  }
  std::vector<std::string> wanted;
  std::istringstream words(text + ",");
  std::string names;
  for (const std::string& name : known) {
    names += name + ", ";
  }
  for (std::string word; std::getline(words, word, ',');) {
    if (std::ranges::find(known, word) == known.end()) {
      throw InputError(option, "", "'" + word + "' is none of " + names + "or " + all);
    }
    wanted.push_back(word);
  }
  std::vector<std::string> ordered;
  std::ranges::copy_if(known, std::back_inserter(ordered),
                       [&](const std::string& name) { return std::ranges::find(wanted, name) != wanted.end(); });
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
  const std::string folder = lens.starts_with("bspline") ? "spectacles/presbyopia_" : "bench/";
  std::string name = lens;
  std::ranges::replace(name, '/', '_');
  return built_in_asset(folder + name + ".json").string();
}

render::FrameConfig frame_config(const BenchRow& row, double threshold_px) {
  render::FrameConfig config;
  config.width = config.height = row.size;
  config.mode = row.mode == "adof"  ? render::Mode::adof
                : row.mode == "vis" ? render::Mode::power
                : row.mode == "pin" ? render::Mode::pinhole
                                    : render::Mode::dof;
  config.threshold_px = threshold_px;
  config.samples = 1;
  config.bare = row.shading == "bare";
  config.range = render::MapRange{-1.0, 3.0};
  return config;
}

StageTimes times_of(const render::RenderedFrame& frame) {
  StageTimes times;
  for (const render::vk::StageTime& stage : frame.stages) {
    times.emplace_back(stage.name, stage.milliseconds);
  }
  return times;
}

// A frame that is timed again and again.
struct Job {
  BenchRow row;
  const RenderSetup* setup;
  std::vector<StageTimes> rounds = {};
};

struct PeerJob {
  PeerRow row;
  std::vector<render::SceneRay> rays;
  std::vector<double> rounds = {};
};

class Bench {
 public:
  Bench(const BenchOptions& options, const render::Scene& scene)
      : options_(options),
        scene_(scene),
        lenses_(chosen("--lens", options.lenses, kBenchLenses, "all")),
        modes_(chosen("--mode", options.modes, kBenchModes, "all")),
        shadings_(chosen("--shading", options.shading, kBenchShadings, "both")),
        sizes_(sizes_of(options.sizes)),
        // Settings first: a bad option is said before anything is measured.
        setups_(make_setups()),
        device_(open_device(options.device)),
        renderer_(device_, scene),
        peer_(scene) {
    report_.peer_threads = std::max(1U, std::thread::hardware_concurrency());
  }

  BenchReport run() {
    report_.scene = scene_.source;
    report_.device = device_.name();
    report_.triangles = scene_.triangles.size();
    report_.rounds = options_.rounds;
    const render::DeviceSpeed speed = render::measure_speed(device_);
    report_.gflops = speed.gflops;
    report_.gigabytes_per_s = speed.gigabytes_per_s;
    for (const int size : sizes_) {
      measure_size(size);
    }
    close_device(device_);
    return std::move(report_);
  }

 private:
  // One a lens; the field of view is square, so one serves every size.
  std::vector<RenderSetup> make_setups() {
    std::vector<RenderSetup> setups;
    for (const std::string& lens : lenses_) {
      SceneOptions scene = options_.scene;
      scene.spectacles = spectacles_of(lens);
      scene.size = "512x512";
      scene.eye = "right";  // one eye, as the paper measured
      setups.push_back(make_render_setup(scene, scene_));
    }
    return setups;
  }

  void measure_size(int size) {
    std::vector<Job> jobs;
    std::vector<PeerJob> peers;
    for (std::size_t i = 0; i < lenses_.size(); ++i) {
      for (const std::string& mode : modes_) {
        for (const std::string& shading : shadings_) {
          if (shading == "full" && shadings_.size() > 1 && mode != "adof") {
            continue;
          }
          jobs.push_back({BenchRow{.lens = lenses_[i],
                                   .mode = mode,
                                   .shading = shading,
                                   .size = size,
                                   .triangles = scene_.triangles.size(),
                                   .ms = {},
                                   .stages = {},
                                   .device = device_.name()},
                          &setups_[i]});
        }
      }
      peers.push_back({PeerRow{lenses_[i], size, 0, {}},
                       render::chief_rays(setups_[i].views.front(), setups_[i].lenses, size, size)});
    }
    // Round 0 compiles and touches memory; it does not count. The others take turns, so that what else the machine
    // does meets all of them alike.
    for (int round = 0; round <= options_.rounds; ++round) {
      measure_round(round, jobs, peers);
    }
    for (Job& job : jobs) {
      set_times(job.row, job.rounds);
      report_.rows.push_back(std::move(job.row));
    }
    for (PeerJob& peer : peers) {
      peer.row.rays = peer.rays.size();
      peer.row.ms = spread_of(peer.rounds);
      report_.peers.push_back(std::move(peer.row));
    }
  }

  void measure_round(int round, std::vector<Job>& jobs, std::vector<PeerJob>& peers) {
    for (Job& job : jobs) {
      const render::FrameConfig config = frame_config(job.row, options_.all_effects ? 0.0 : options_.threshold_px);
      StageTimes times = times_of(renderer_.render(job.setup->lenses, job.setup->views, config));
      if (times.empty()) {
        throw render::vk::DeviceError(device_.name() + " has no timestamps; bench needs them");
      }
      if (round > 0) {
        job.rounds.push_back(std::move(times));
      }
      progress(job.row, round);
    }
    for (PeerJob& peer : peers) {
      const double ms = peer_.trace(peer.rays, report_.peer_threads).milliseconds;
      if (round > 0) {
        peer.rounds.push_back(ms);
      }
    }
  }

  void progress(const BenchRow& row, int round) const {
    if (::isatty(STDERR_FILENO) != 0) {
      std::fprintf(stderr, "\r%dx%d round %d of %d: %-16s %-4s %-4s ", row.size, row.size, round, options_.rounds,
                   row.lens.c_str(), row.mode.c_str(), row.shading.c_str());
    }
  }

  const BenchOptions& options_;
  const render::Scene& scene_;
  std::vector<std::string> lenses_, modes_, shadings_;
  std::vector<int> sizes_;
  std::vector<RenderSetup> setups_;
  render::vk::Device device_;
  render::Renderer renderer_;
  render::PacketTracer peer_;
  BenchReport report_;
};

int bench(BenchOptions options) {
  check_range("--rounds", options.rounds, 1, 1000, "");
  check_range("--threshold", options.threshold_px, 0.0, 1000.0, "px");
  if (options.scene.scene.empty()) {
    const std::filesystem::path cars = fetched_car_scene();
    options.scene.scene = (cars.empty() ? built_in_scene() : cars).string();
  }
  if (!options.figures.empty()) {
    const FigureOptions figures{made_folder("--figures", options.figures), options.scene.scene, options.device};
    for (const std::string& file : write_figures(figures)) {
      std::cout << file << '\n';
    }
  } else {
    const std::filesystem::path folder =
        options.output.empty() ? std::filesystem::path() : made_folder("--output", options.output);
    const render::Scene scene = render::read_gltf(options.scene.scene);
    const BenchReport report = Bench(options, scene).run();
    if (::isatty(STDERR_FILENO) != 0) {
      std::fprintf(stderr, "\r%-70s\r", "");
    }
    if (!folder.empty()) {
      write_text(folder / "bench.csv", rows_csv(report.rows, report.peers));
      write_text(folder / "bench.svg", to_svg(bench_chart(report)));
      render::write_png(folder / "bench.png", to_image(bench_chart(report)));
      write_text(folder / "report.html", bench_page(report));
    }
    std::cout << (options.json ? rows_json(report.rows, report.peers) : bench_table(report));
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
  CLI::App* command = program.add_subcommand("bench", "Milliseconds a stage, the paper's Table 1 among them");
  command->footer(
      "Example:\n"
      "  vergence bench --lens none,bspline/sphere --mode adof --size 512,1024,2048 --output report\n"
      "Rows that are called bare are drawn as the paper did, with one light, no shadow rays and one ray a pixel, and\n"
      "stand beside its GTX 480; full rows are what render draws. Frames take turns over several rounds. Embree's\n"
      "packets of 16 rays trace the same scene rays in the same run, on all threads of the CPU.");
  command->add_option("--scene", options->scene.scene,
                      "FILE.gltf or FILE.glb [the cars of assets/fetch_scenes.sh if fetched, else the reading room]");
  command->add_option("--wearer", options->scene.wearer, "Wearer file [35 years, emmetropic]");
  command->add_option("--viewing", options->scene.viewing, "fixed, scanning or gaze, as for render")
      ->check(CLI::IsMember({"fixed", "scanning", "gaze"}))
      ->capture_default_str();
  command
      ->add_option("--lens", options->lenses,
                   "all, or some of none,sphere/sphere,sphere/torus,bspline/sphere,bspline/torus")
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
  command->add_option("--rounds", options->rounds, "How often each frame is timed")->capture_default_str();
  command->add_option("--threshold", options->threshold_px, "Blurs with a smaller major semi-axis are not drawn, px")
      ->capture_default_str();
  command->add_flag("--all-effects", options->all_effects, "Draw every blur, however small");
  command->add_option("--device", options->device, "GPU by name or index [the first discrete, else any]");
  auto* output =
      command->add_option("--output", options->output, "Folder for bench.csv, a chart (svg, png) and report.html");
  command->add_option("--figures", options->figures, "Folder for the paper's Figures 1, 4, 5 and 6; measures nothing")
      ->excludes(output);
  command->add_flag("--json", options->json, "Print the rows as JSON");
  return [options] { return bench(*options); };
}

}  // namespace app
