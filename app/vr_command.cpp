// vergence vr: live in the headset, through OpenXR.
#include <filesystem>
#include <iostream>
#include <memory>

#include "app/commands.hpp"
#include "app/mode_option.hpp"
#include "app/option_values.hpp"
#include "app/output_place.hpp"
#include "app/vr/options.hpp"
#include "app/vr/report.hpp"
#include "app/vr/run.hpp"
#include "tracking/input_error.hpp"

namespace app {
namespace {

using tracking::InputError;

constexpr std::size_t kMostFurther = 16;  // each is compiled for before the first picture
constexpr int kMostSamples = 1024, kMostFrames = 100'000'000;
constexpr double kLongestWait_s = 86400.0;

void check_options(const VrOptions& options) {
  check_picture_options(options.picture);
  check_range("--samples", options.samples, 1, kMostSamples, "");
  check_range("--reconnect", options.reconnect_s, 0.0, kLongestWait_s, "s");
  if (options.frames) {
    check_range("--frames", *options.frames, 1, kMostFrames, "");
  }
  if (!options.record.empty()) {
    check_place(options.record);
  }
  if (options.scene.further.size() > kMostFurther) {
    throw InputError("--pairs", "",
                     "names " + std::to_string(options.scene.further.size()) + " files; at most " +
                         std::to_string(kMostFurther) + " can be worn in turn");
  }
  if (!options.size.empty()) {
    (void)size_of("--size", options.size);
  }
  if (!options.screenshot.empty()) {
    if (std::filesystem::path(options.screenshot).extension() != ".png") {
      throw InputError("--screenshot", "", "'" + options.screenshot + "' must end in .png");
    }
    check_place(options.screenshot);
  }
}

int run(const VrOptions& options) {
  check_options(options);
  const VrReport report = run_vr(options);
  std::cout << (options.json ? to_json(report) : to_table(report)) << std::flush;
  if (!std::cout) {
    throw std::runtime_error("standard output: cannot be written");
  }
  return 0;
}

}  // namespace

Action add_vr_command(CLI::App& program) {
  auto options = std::make_shared<VrOptions>();
  CLI::App* command = program.add_subcommand("vr", "A scene through spectacles, live in the headset (OpenXR)");
  command->footer(
      "Example:\n"
      "  vergence vr --wearer assets/wearers/presbyopia.json \\\n"
      "    --spectacles assets/spectacles/presbyopia_bspline_sphere.json --headset assets/headsets/example.json\n"
      "An OpenXR runtime must run (SteamVR, WiVRn, Monado); XR_RUNTIME_JSON names another than the active one. Ctrl-C\n"
      "ends it. Not a medical device.");
  add_wearing_options(*command, options->scene,
                      {.scene = "FILE.gltf or FILE.glb [the built-in reading room]",
                       .spectacles = "Spectacles file, or none",
                       .compare = "A second pair: A left, B right of a divider in each eye"});
  command->add_option("--pairs", options->scene.further,
                      "FILE... of further pairs, put on in turn by the control next pair; without --compare the one\n"
                      "worn is held against the next");
  command->add_option(
      "--pose", options->scene.pose,
      "X,Y,Z,YAW,PITCH (m, deg) of the scene where the room's centre stands, its height above the\n"
      "floor only for a space without one; or a camera of the scene by name or number [below the first\n"
      "camera; without one, before the whole scene]");
  command->add_option("--mode", options->mode, "What the picture shows")
      ->check(CLI::IsMember(mode_names()))
      ->capture_default_str();
  add_picture_options(*command, options->picture,
                      "Rung of the accuracy ladder, or auto: as exactly as the display's rate allows, or as recorded");
  command->add_option("--samples", options->samples, "Rays a pixel and frame (dof)")->capture_default_str();
  command->add_option("--range", options->range, "LO,HI of a map, D or arcmin [by map]");
  command->add_option("--colormap", options->colour_map, "hsv (as in the paper) or viridis (perceptual)")
      ->check(CLI::IsMember({"hsv", "viridis"}))
      ->capture_default_str();
  command->add_option("--size", options->size, "WxH in pixels of each eye's image [as the runtime recommends]");
  command
      ->add_option("--space", options->space,
                   "The runtime's space that the scene stands in: auto is local_floor, else stage, else local")
      ->check(CLI::IsMember({"auto", "local_floor", "stage", "local"}))
      ->capture_default_str();
  command->add_option("--frames", options->frames, "End after this many pictures [until the session ends]");
  command
      ->add_option("--reconnect", options->reconnect_s,
                   "Seconds that a runtime which went away is waited for; the session and its recording then go on")
      ->capture_default_str();
  auto* record = command->add_option("--record", options->record,
                                     "FILE.csv of poses, gaze, pupils and accommodation, a line a picture, and\n"
                                     "FILE.csv.json of views, rung, pair and events");
  command
      ->add_option("--replay", options->replay,
                   "FILE.csv to draw from, a line a picture: a recording gives the same pictures on the same device")
      ->excludes(record);
  command->add_option("--screenshot", options->screenshot, "FILE.png of the last picture, left eye | right eye");
  command->add_flag("--mirror", options->mirror,
                    "Open a window on the desktop with what the headset shows, left eye | right eye. Its keys:\n"
                    "Space spectacles on and off, N next pair, C compare, M map, T next target, R recentre,\n"
                    "Escape clear view; Q or closing the window ends the session");
  command->add_flag("--no-text", options->no_text,
                    "Nothing to read in the headset; neither a recording nor a screenshot holds its text anyway");
  command->add_option("--device", options->device, "Checked only: the headset says which GPU it hangs on");
  command->add_flag("--json", options->json, "Print the numbers as JSON");
  return [options] { return run(*options); };
}

}  // namespace app
