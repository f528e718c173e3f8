// vergence render: a scene through spectacles into an image.
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

#include "app/commands.hpp"
#include "app/device.hpp"
#include "app/mode_option.hpp"
#include "app/output_place.hpp"
#include "app/picture.hpp"
#include "app/render_report.hpp"
#include "app/render_setup.hpp"
#include "app/scene_options.hpp"
#include "render/image/colour_bar.hpp"
#include "render/image/exr.hpp"
#include "render/image/png.hpp"
#include "render/ladder.hpp"
#include "render/renderer.hpp"
#include "tracking/input_error.hpp"

namespace app {
namespace {

using render::Mode;
using tracking::InputError;

struct RenderOptions {
  SceneOptions scene;
  PictureOptions picture;
  std::string mode;  // empty: the rung's, or adof
  std::optional<int> samples;
  std::optional<double> target_error;
  std::string range;
  std::string colour_map = "hsv";
  std::string output = "out.png";
  std::string channels = "rgb";
  std::string device;
  std::string timings;
  int repeat = 1;
  std::uint32_t seed = 0;
  bool json = false;
};

constexpr int kMostSamples = 65536, kDefaultSamples = 64, kSamplesForTarget = 4096;

bool is_exr(const std::string& output) {
  return std::filesystem::path(output).extension() == ".exr";
}

void check_options(const RenderOptions& options) {
  const auto extension = std::filesystem::path(options.output).extension();
  if (extension != ".png" && extension != ".exr") {
    throw InputError("--output", "", "'" + options.output + "' must end in .png or .exr");
  }
  check_place(options.output);
  if (!options.timings.empty()) {
    check_place(options.timings);
    check_timings(options.timings);
    if (std::filesystem::weakly_canonical(options.timings) == std::filesystem::weakly_canonical(options.output)) {
      throw InputError("--timings", "", "'" + options.timings + "' is also the --output; name another file");
    }
  }
  if (options.channels == "all" && !is_exr(options.output)) {
    throw InputError("--channels", "", "all needs an .exr --output; a .png holds the picture only");
  }
  check_picture_options(options.picture);
  if (options.samples) {
    check_range("--samples", *options.samples, 1, kMostSamples, "");
  }
  if (options.target_error) {
    check_range("--target-error", *options.target_error, 1e-6, 1.0, "");
  }
  check_range("--repeat", options.repeat, 1, 1000, "");
}

std::optional<render::MapRange> range_of(const RenderOptions& options) {
  if (options.range.empty()) {
    return std::nullopt;
  }
  const auto v = numbers_of("--range", options.range, 2, "LO,HI, such as 0,3");
  if (!(v[0] < v[1])) {
    throw InputError("--range", "", "'" + options.range + "' must have LO below HI");
  }
  return render::MapRange{v[0], v[1]};
}

render::FrameConfig frame_config(const RenderOptions& options, const RenderSetup& setup) {
  render::FrameConfig config;
  config.width = setup.size[0];
  config.height = setup.size[1];
  config.mode = mode_of(options.mode);
  config.accuracy = render::find_rung(options.picture.accuracy)->accuracy;
  config.threshold_px = options.picture.threshold();
  config.exposure = options.picture.exposure;
  config.samples = options.samples.value_or(options.target_error ? kSamplesForTarget : kDefaultSamples);
  config.target_error = options.target_error;
  config.seed = options.seed;
  config.colour_map = options.colour_map == "hsv" ? 0 : 1;
  config.range = range_of(options);
  config.keep_radiance = is_exr(options.output) && !render::is_map(config.mode);
  config.keep_wavefront = options.channels == "all";
  return config;
}

std::string map_unit(Mode mode) {
  return mode == Mode::blur ? "arcmin" : "D";
}

void write_picture(const RenderOptions& options, const PictureLayout& layout, const render::RenderedFrame& frame,
                   Mode mode) {
  if (is_exr(options.output)) {
    render::write_exr(options.output, compose_channels(layout, frame, options.channels == "all"));
    return;
  }
  render::Image8 picture = compose_display(layout, frame);
  if (render::is_map(mode)) {
    const std::string title = mode == Mode::blur ? "blur, semi-axis" : options.mode;
    render::draw_colour_bar(picture, render::colour_bar_place(picture), options.colour_map == "hsv" ? 0 : 1,
                            frame.range.low, frame.range.high, map_unit(mode), title);
  }
  render::write_png(options.output, picture);
}

render::Progress progress_bar(bool wanted) {
  if (!wanted || ::isatty(STDERR_FILENO) == 0) {
    return {};
  }
  return [](int done, int of) { std::fprintf(stderr, "\r%d of at most %d samples", done, of); };
}

struct Drawn {
  render::RenderedFrame frame;  // the last
  std::vector<std::vector<render::vk::StageTime>> runs;
};

Drawn draw_frames(const RenderOptions& options, const RenderSetup& setup, const render::FrameConfig& config,
                  render::Renderer& renderer, StartUp& start_up) {
  const auto draw = [&](const render::Progress& progress) {
    try {
      return renderer.render(setup.lenses, setup.views, config, progress);
    } catch (const render::vk::DeviceError& error) {
      throw render::vk::DeviceError("rendering " + options.scene.size + " pixels: " + error.what());
    }
  };
  if (options.repeat > 1) {
    // The first frame also pays for compiling; it is not timed.
    static_cast<void>(draw({}));
    start_up.mark("first frame");
  }
  Drawn drawn;
  for (int i = 0; i < options.repeat; ++i) {
    const render::Progress progress = progress_bar(config.mode == Mode::dof);
    drawn.frame = draw(progress);
    if (options.repeat == 1) {
      start_up.mark("first frame");
    }
    if (progress) {
      std::fputc('\n', stderr);
    }
    drawn.runs.push_back(drawn.frame.stages);
  }
  return drawn;
}

RenderReport report_of(const RenderOptions& options, const RenderSetup& setup, const render::FrameConfig& config,
                       const Drawn& drawn) {
  RenderReport report;
  report.output = options.output;
  report.mode = options.mode;
  report.width = config.width;
  report.height = config.height;
  report.views = setup.views.size();
  report.samples = drawn.frame.samples;
  report.error_estimate = drawn.frame.error_estimate;
  report.is_map = render::is_map(config.mode);
  report.range_low = drawn.frame.range.low;
  report.range_high = drawn.frame.range.high;
  report.range_unit = map_unit(config.mode);
  report.sight = sight_rows(setup);
  report.findings = viewer_report(setup);
  report.stages = stage_rows(drawn.runs);
  report.peak_memory_mib = peak_memory_mib();
  return report;
}

// A rung may say the mode and the samples too; what is given beside it has the last word.
RenderOptions with_rung(RenderOptions options) {
  const render::Rung& rung = *render::find_rung(options.picture.accuracy);
  if (options.mode.empty()) {
    options.mode = mode_names()[static_cast<std::size_t>(rung.mode.value_or(Mode::adof))];
  }
  if (!options.samples && !options.target_error && options.mode == "dof") {
    options.samples = rung.samples;
  }
  return options;
}

int render_picture(const RenderOptions& given) {
  StartUp start_up;
  const RenderOptions options = with_rung(given);
  check_options(options);
  const std::string scene_file = options.scene.scene.empty() ? built_in_scene().string() : options.scene.scene;
  const render::Scene scene = render::read_gltf(scene_file);
  start_up.mark("scene");
  const RenderSetup setup = make_render_setup(options.scene, scene);
  start_up.mark("fixation");
  const render::FrameConfig config = frame_config(options, setup);
  render::vk::Device device = open_device(options.device);
  start_up.mark("device");
  render::Renderer renderer(device, scene,
                            {.traversal = render::Traversal::automatic, .traversal_file = traversal_file()});
  start_up.mark("trees and textures");
  const Drawn drawn = draw_frames(options, setup, config, renderer, start_up);
  close_device(device);
  const PictureLayout layout{config.width, config.height, setup.pairs.size(), setup.sides.size()};
  write_picture(options, layout, drawn.frame, config.mode);
  RenderReport report = report_of(options, setup, config, drawn);
  report.device = device.name();
  report.triangles = scene.triangles.size();
  report.start_up = start_up.parts();
  if (!options.timings.empty()) {
    append_timings(options.timings, report);
  }
  std::cout << (options.json ? to_json(report) : to_table(report)) << std::flush;
  if (!std::cout) {
    throw std::runtime_error("standard output: cannot be written");
  }
  return 0;
}

// How many eyes and pixels.
void add_view_options(CLI::App& command, SceneOptions& scene) {
  command.add_option("--eye", scene.eye, "left, right, or both (left | right side by side)")
      ->check(CLI::IsMember({"left", "right", "both"}))
      ->capture_default_str();
  command.add_option("--size", scene.size, "WxH in pixels, of each eye's picture")->capture_default_str();
}

}  // namespace

Action add_render_command(CLI::App& program) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App* command = program.add_subcommand("render", "A scene through spectacles into an image");
  command->footer(
      "Example:\n"
      "  vergence render --wearer assets/wearers/presbyopia.json \\\n"
      "    --spectacles assets/spectacles/presbyopia_bspline_sphere.json --look-at near_card --output near.png\n"
      "The picture is centred on the gaze; head and lens stay where they are.");
  add_scene_options(*command, options->scene);
  add_view_options(*command, options->scene);
  command->add_option("--mode", options->mode, "What the picture shows [adof, or what --accuracy asks for]")
      ->check(CLI::IsMember(mode_names()));
  add_picture_options(*command, options->picture);
  auto* samples = command->add_option("--samples", options->samples, "Rays a pixel (dof) [64, or as --accuracy says]");
  command
      ->add_option("--target-error", options->target_error,
                   "Stop when the standard error of the mean luminance falls below this (dof)")
      ->excludes(samples);
  command->add_option("--range", options->range, "LO,HI of a map, D or arcmin [from the picture]");
  command->add_option("--colormap", options->colour_map, "hsv (as in the paper) or viridis (perceptual)")
      ->check(CLI::IsMember({"hsv", "viridis"}))
      ->capture_default_str();
  command->add_option("--output", options->output, "FILE.png (sRGB) or FILE.exr (linear)")->capture_default_str();
  command
      ->add_option("--channels", options->channels,
                   "rgb, or all (EXR: depth, V.hh, V.hv, V.vv, blur, accommodation too)")
      ->check(CLI::IsMember({"rgb", "all"}))
      ->capture_default_str();
  command->add_option("--device", options->device, "GPU by name or index [the first discrete, else any]");
  command->add_option("--repeat", options->repeat, "Render so often after a first, untimed frame; report the median")
      ->capture_default_str();
  command->add_option("--timings", options->timings,
                      "CSV file that a row a stage is added to, and one a part of the start-up");
  command->add_option("--seed", options->seed, "Of the sampling pattern (dof)")->capture_default_str();
  command->add_flag("--json", options->json, "Print the numbers as JSON");
  return [options] { return render_picture(*options); };
}

}  // namespace app
